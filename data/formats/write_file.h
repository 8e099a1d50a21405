#pragma once
#include <string>

namespace ostium::data {

/// Writes `text`, creating folders as needed. Throws std::runtime_error naming the file if it cannot be written
/// completely.
void write_file(const std::string& path, const std::string& text);

}  // namespace ostium::data
