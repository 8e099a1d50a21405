#pragma once
/// The tubes, names and landmarks of an imported lumen as JSON (data/schemas/anatomy.schema.json; patient frame, mm).
#include <string>

#include "vascular/anatomy/anatomy.h"

namespace ostium::data {

std::string anatomy_to_json(const vascular::Anatomy& anatomy);

/// Throws LoadError with file, line, key, value found and what was expected.
vascular::Anatomy read_anatomy(const std::string& file, const std::string& text);
vascular::Anatomy load_anatomy(const std::string& file);

}  // namespace ostium::data
