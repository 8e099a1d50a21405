#pragma once
#include <cstddef>
#include <string>

namespace ostium::data {

/// What a file holds. Throws LoadError where it is not there, may not be read, or is none but a folder, pipe or device:
/// those give no text, give it once only, or never end; or is longer than `most` bytes. `expected`: what belongs there,
/// for the message.
std::string read_file(const std::string& file, const std::string& expected = "a file", std::size_t most = 1 << 28);

}  // namespace ostium::data
