#include "data/formats/read_file.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "data/formats/load_error.h"
#include "data/formats/paths.h"
#include "vascular/geometry/mesh_files/formats.h"

namespace ostium::data {

void require_file(const std::string& file, const std::string& expected) {
  if (const std::string why = why_no_file(file); !why.empty())
    throw LoadError(fmt::format("{}: cannot be read, {}; expected {}", file, why, expected));
}

std::string read_file(const std::string& file, const std::string& expected, std::size_t most) {
  require_file(file, expected);
  std::error_code none;
  if (std::filesystem::file_size(file, none) > most && !none)
    throw LoadError(fmt::format("{}: has more than {} MiB; expected {}, at most so long", file, most >> 20, expected));
  std::ifstream in(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  if (in.bad() || !in.is_open()) throw LoadError(file + ": cannot be read; expected " + expected);
  return text;
}

void require_utf8(const std::string& file, std::string_view text) {
  if (vascular::is_utf16(text)) throw LoadError(file + ": " + vascular::utf16_cure);
}

}  // namespace ostium::data
