#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace ostium::data {

/// Throws LoadError where nothing is there, or no file but a folder, pipe, socket or device: those give nothing, give
/// it once only, or never end. `expected`: what belongs there, for the message.
void require_file(const std::string& file, const std::string& expected = "a file");

/// What a file holds. Throws LoadError as above, or where it may not be read, or is longer than `most` bytes.
std::string read_file(const std::string& file, const std::string& expected = "a file", std::size_t most = 1 << 28);

/// Throws LoadError where a text is UTF-16, which editors and shells of Windows write unless told otherwise.
void require_utf8(const std::string& file, std::string_view text);

}  // namespace ostium::data
