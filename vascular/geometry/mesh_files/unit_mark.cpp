#include "vascular/geometry/mesh_files/unit_mark.h"

#include <algorithm>
#include <fstream>
#include <sstream>

#include "vascular/geometry/mesh_files/formats.h"

namespace ostium::vascular {

namespace {

constexpr std::size_t looked_at = 2000;  // bytes; comments stand at the beginning
constexpr std::size_t stl_header = 80;

/// Of "unit mm", "Units: mm".
std::optional<LengthUnit> unit_of_words(std::istringstream words) {
  std::string key, name;
  words >> key >> name;
  key = in_lower_case(key);
  if (key.ends_with(':')) key.pop_back();
  if (key != "unit" && key != "units") return std::nullopt;
  name = in_lower_case(name);
  for (LengthUnit unit : length_units)
    if (name_of(unit) == name) return unit;
  return std::nullopt;
}

}  // namespace

std::string with_unit_mark(std::string bytes, const std::string& ending, LengthUnit unit) {
  const std::string mark = "unit " + name_of(unit);
  if (ending == ".stl") {
    std::string header = mark;
    header.resize(std::min(stl_header, bytes.size()), '\0');
    return bytes.replace(0, header.size(), header);
  }
  if (ending == ".obj") return "# " + mark + "\n" + bytes;
  // Behind "ply" and the format, which have to come first.
  const std::size_t second = bytes.find('\n', bytes.find('\n') + 1);
  return bytes.insert(second + 1, "comment " + mark + "\n");
}

std::optional<LengthUnit> unit_mark_of(const std::string& path) {
  const std::string ending = ending_of(path);
  std::string start(looked_at, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(file.gcount()));
  if (ending == ".stl") return unit_of_words(std::istringstream(start.substr(0, start.find('\0'))));
  const std::string comment = ending == ".ply" ? "comment" : ending == ".obj" ? "#" : "";
  if (comment.empty()) return std::nullopt;
  std::istringstream lines(start);
  for (std::string line; std::getline(lines, line) && line != "end_header";)
    if (line.starts_with(comment))
      if (const auto unit = unit_of_words(std::istringstream(line.substr(comment.size())))) return unit;
  return std::nullopt;
}

}  // namespace ostium::vascular
