#pragma once
#include <string>

namespace ostium::data {

/// Writes `text` whole, making the folders on the way. Throws std::runtime_error naming the file if it cannot be.
void write_file(const std::string& path, const std::string& text);

}  // namespace ostium::data
