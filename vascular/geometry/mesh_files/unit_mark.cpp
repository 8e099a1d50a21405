#include "vascular/geometry/mesh_files/unit_mark.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

#include "vascular/geometry/mesh_files/formats.h"
#include "vascular/geometry/mesh_files/paths.h"
#include "vascular/geometry/mesh_files/raw_surface.h"

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

constexpr const char* slicer_axes[] = {"LPS", "RAS"};

/// Of the words "SPACE=LPS".
std::optional<std::string> axes_of_words(const std::string& text) {
  std::istringstream words(text);
  for (std::string word; words >> word;)
    for (const char* axes : slicer_axes)
      if (word == std::string("SPACE=") + axes) return axes;
  return std::nullopt;
}

/// Of the field SPACE, which may stand anywhere in the file.
std::optional<std::string> axes_of_xml(const std::string& path) {
  std::error_code unseen;
  if (!is_file(path) || std::filesystem::file_size(path, unseen) > longest_mesh_file) return std::nullopt;
  const std::string said = read_vtk_field(path, "SPACE");
  for (const char* axes : slicer_axes)
    if (said == axes) return axes;
  return std::nullopt;
}

/// Empty of what is no file: a pipe would be waited for, and read away from whoever reads it next.
std::string beginning_of(const std::string& path) {
  if (!is_file(path)) return "";
  std::string start(looked_at, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(file.gcount()));
  return start;
}

/// What is behind the sign of a comment, in the lines before the numbers.
std::vector<std::string> comments_in(const std::string& beginning, const std::string& ending) {
  std::vector<std::string> comments;
  const std::string sign = ending == ".ply" ? "comment" : ending == ".obj" ? "#" : "";
  if (sign.empty()) return comments;
  std::istringstream lines(beginning);
  for (std::string line; std::getline(lines, line) && !line.starts_with("end_header");)
    if (line.starts_with(sign)) comments.push_back(line.substr(sign.size()));
  return comments;
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
  const std::string start = beginning_of(path);
  if (ending == ".stl") return unit_of_words(std::istringstream(start.substr(0, start.find('\0'))));
  for (const std::string& comment : comments_in(start, ending))
    if (const auto unit = unit_of_words(std::istringstream(comment))) return unit;
  return std::nullopt;
}

std::optional<std::string> axes_mark_of(const std::string& path) {
  const std::string ending = ending_of(path), start = beginning_of(path);
  if (ending == ".stl") {  // the header of a binary file, or the first line of text
    const std::string header = start.substr(0, std::min(start.find_first_of(std::string("\0\n", 2)), looked_at));
    return axes_of_words(start.starts_with("solid") ? header : header.substr(0, stl_header));
  }
  if (ending == ".vtp" || ending == ".vtu" || ending == ".vtk") {  // XML or not, whatever the ending
    if (!start.starts_with('#')) return axes_of_xml(path);
    const std::size_t title = start.find('\n') + 1;
    return axes_of_words(start.substr(title, start.find('\n', title) - title));
  }
  for (const std::string& comment : comments_in(start, ending))
    if (const auto axes = axes_of_words(comment)) return axes;
  return std::nullopt;
}

}  // namespace ostium::vascular
