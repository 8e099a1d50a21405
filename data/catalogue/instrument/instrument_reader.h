#pragma once
/// Reads instrument files. What is wrong throws LoadError: "FILE:LINE: KEY is VALUE; expected ...".
#include "data/catalogue/instrument/instrument.h"
#include "data/formats/load_error.h"

namespace ostium::data {

/// `file` names it in messages and, without folder and .json, must be the instrument's name.
Instrument read_instrument(const std::string& file, const std::string& text);
Instrument load_instrument(const std::string& file);

}  // namespace ostium::data
