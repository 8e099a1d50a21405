#include "data/formats/read_file.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "data/formats/load_error.h"

namespace ostium::data {

std::string read_file(const std::string& file, const std::string& expected, std::size_t most) {
  std::error_code none;
  const auto kind = std::filesystem::status(file, none).type();
  if (kind == std::filesystem::file_type::not_found)
    throw LoadError(file + ": cannot be read, there is no such file; expected " + expected);
  if (kind != std::filesystem::file_type::regular)
    throw LoadError(file + ": cannot be read, it is a folder, a pipe or a device; expected " + expected +
                    ", written to a file first");
  if (std::filesystem::file_size(file, none) > most && !none)
    throw LoadError(fmt::format("{}: has more than {} MiB; expected {}, at most so long", file, most >> 20, expected));
  std::ifstream in(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  if (in.bad() || !in.is_open()) throw LoadError(file + ": cannot be read; expected " + expected);
  return text;
}

}  // namespace ostium::data
