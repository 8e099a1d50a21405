#include "vascular/geometry/mesh_files/whole_stl.h"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "vascular/geometry/mesh/mesh.h"
#include "vascular/geometry/mesh_files/formats.h"

namespace ostium::vascular {

namespace {

constexpr std::size_t facet_bytes = 4000;  // more than one has
constexpr std::uintmax_t header_bytes = 84, triangle_bytes = 50;

/// Binary files may begin with "solid" as well, but they have zeros in their header or in their first numbers.
bool is_text(std::istream& file) {
  std::array<char, 1024> start;
  file.read(start.data(), start.size());
  const std::string_view read(start.data(), static_cast<std::size_t>(file.gcount()));
  file.clear();
  file.seekg(0);
  return read.find('\0') == std::string_view::npos;
}

std::uint32_t promised_triangles(std::istream& file) {
  std::array<unsigned char, header_bytes> header;
  file.read(reinterpret_cast<char*>(header.data()), header.size());
  std::uint32_t triangles = 0;  // little-endian, whatever this machine is
  for (int k = 3; k >= 0; --k) triangles = triangles << 8 | header[80 + static_cast<std::size_t>(k)];
  return triangles;
}

void check_binary(const std::string& path, std::istream& file) {
  const std::uintmax_t size = std::filesystem::file_size(path);
  if (size < header_bytes)
    throw MeshError(
        fmt::format("{}: is cut short: {} of the {} bytes of its header are there; expected the whole file, "
                    "copy it again",
                    path, size, header_bytes));
  const std::uint32_t promised = promised_triangles(file);
  const std::uintmax_t bytes = size - header_bytes, held = bytes / triangle_bytes;
  if (held < promised)
    throw MeshError(
        fmt::format("{}: is cut short: its header promises {} triangles, and {} are there; expected the "
                    "whole file, copy it again",
                    path, promised, held));
  if (bytes != promised * triangle_bytes)
    throw MeshError(
        fmt::format("{}: its header promises {} triangles, and {} and {} more bytes are there; expected as "
                    "many as promised, export it again",
                    path, promised, held, bytes % triangle_bytes));
}

/// "endsolid" may stand anywhere in the last line: some programs write no line ends, or those of old Macs.
void check_text(const std::string& path, std::istream& file) {
  std::string first, last;
  long facets = 0;
  for (std::string line; std::getline(file, line);) {
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin == std::string::npos) continue;
    last = in_lower_case(line.substr(begin));
    if (first.empty()) first = last;
    facets += last.starts_with("endfacet");
  }
  if (first.starts_with("solid") && last.find("endsolid") == std::string::npos)
    throw MeshError(
        fmt::format("{}: is cut short: no \"endsolid\" stands after its {} whole facets; expected the whole file, copy "
                    "it again, or add that line if nothing is missing",
                    path, facets));
}

}  // namespace

void check_stl_whole(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (is_text(file))
    check_text(path, file);
  else
    check_binary(path, file);
}

std::string stl_in_capitals(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!is_text(file)) return "";
  std::string text(std::istreambuf_iterator<char>(file), {});
  // The words of the first facet, behind the name.
  const std::string facet = text.substr(std::min(text.find_first_of("\r\n"), text.size()), facet_bytes);
  for (const char* word : {"facet", "outer", "loop", "vertex"})
    if (facet.find(word) == std::string::npos) return in_lower_case(std::move(text));
  return "";
}

}  // namespace ostium::vascular
