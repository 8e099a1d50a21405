#pragma once
/// Reads instrument files. Errors throw LoadError: "FILE:LINE: KEY is VALUE; expected ...".
#include "data/catalogue/instrument/instrument.h"
#include "data/formats/load_error.h"

namespace ostium::data {

/// `file` is the name used in messages; without folder and .json it must be the instrument's name.
Instrument read_instrument(const std::string& file, const std::string& text);
Instrument load_instrument(const std::string& file);

}  // namespace ostium::data
