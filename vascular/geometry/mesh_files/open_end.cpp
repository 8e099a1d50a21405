#include "vascular/geometry/mesh_files/open_end.h"

#include <algorithm>
#include <fstream>

#include "vascular/geometry/mesh_files/formats.h"

namespace ostium::vascular {

namespace {

std::string bytes_at(std::ifstream& file, std::streamoff from, std::size_t count) {
  std::string bytes(count, '\0');
  file.clear();
  file.seekg(from);
  file.read(bytes.data(), static_cast<std::streamsize>(count));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

bool is_text(const std::string& ending, const std::string& begins) {
  if (ending == ".obj") return true;
  if (ending == ".ply") return begins.find("format ascii") != std::string::npos;
  if (ending == ".off") return begins.find("BINARY") == std::string::npos;
  return ending == ".vtk" && begins.find("\nASCII") != std::string::npos;
}

}  // namespace

std::string doubt_of_mesh_end(const std::string& path) {
  constexpr std::size_t looked_at = 1024;
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = file.tellg();
  if (!file || size <= 0 || !is_text(ending_of(path), bytes_at(file, 0, looked_at))) return "";
  const std::string ends = bytes_at(file, std::max<std::streamoff>(0, size - looked_at), looked_at);
  const std::string last = ends.substr(ends.find_last_of("\r\n") + 1);  // all of it, where no line ends
  if (last.find_first_not_of(" \t") == std::string::npos || last.back() == ' ' || last[0] == '#') return "";
  return "the last line of " + path + " has no end: its last number may have been cut; if it is whole, end the line";
}

}  // namespace ostium::vascular
