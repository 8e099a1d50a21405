#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <span>

#include "vascular/geometry/mesh/mesh.h"
#include "vascular/geometry/mesh/polygon.h"
#include "vascular/geometry/mesh_files/formats.h"
#include "vascular/geometry/mesh_files/raw_surface.h"
#include "vascular/geometry/mesh_files/vtk/vtk_numbers.h"

namespace ostium::vascular {

namespace {

/// The words of a file's lines: a line is a vertex, with a normal, a colour or a place in a texture behind it, or a
/// face, with a colour behind it. Comments begin with #.
class OffText {
 public:
  OffText(std::string path, std::string text) : path_(std::move(path)), text_(std::move(text)), rest_(text_) {}

  /// Goes to the next line with words; false at the end.
  bool next_line() {
    line_ = {};
    while (!rest_.empty() && line_.empty()) {
      const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
      line_ = rest_.substr(0, std::min(end, rest_.find('#')));
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      if (line_.find_first_not_of(" \t\f\v") == std::string_view::npos) line_ = {};
    }
    return !line_.empty();
  }
  std::string_view word() { return take_word(line_); }
  std::string_view line() const { return line_; }

  template <class N>
  N number(const char* what) {
    const std::string_view found = word();
    const auto value = vtk_number<N>(found);
    if (!value) refuse(fmt::format("has \"{:.40}\" for {}; expected a number", found, what));
    return *value;
  }

  /// Of vertices or faces; each takes four bytes at least.
  std::size_t count(const char* what) {
    const std::size_t most = text_.size() / 4;
    const std::string found(word());
    const auto value = vtk_number<std::int64_t>(found);
    if (!value || *value < 0) refuse(fmt::format("has \"{:.40}\" for {}; expected a whole number", found, what));
    if (static_cast<std::uint64_t>(*value) > most)
      refuse(
          fmt::format("promises {} vertices or faces, and its {} bytes cannot hold more than {}; expected the whole "
                      "file, copy it again",
                      *value, text_.size(), most));
    return static_cast<std::size_t>(*value);
  }

  [[noreturn]] void refuse(const std::string& why) const { throw MeshError(fmt::format("{}: {}", path_, why)); }
  [[noreturn]] void cut_short(std::size_t promised, const char* what, std::size_t read) const {
    refuse(fmt::format("is cut short: promises {} {}, and {} could be read; expected the whole file, copy it again",
                       promised, what, read));
  }

 private:
  std::string path_, text_;
  std::string_view rest_, line_;
};

/// The first word may be missing, and the counts may stand on its line.
void pass_header(OffText& in) {
  if (!in.next_line()) in.refuse("holds nothing; expected \"OFF\" and the numbers of vertices and faces");
  if (in.line().find("OFF") == std::string_view::npos) return;
  const std::string name(in.word());
  if (name.find_first_of("4n") != std::string::npos || in.line().find("BINARY") != std::string_view::npos)
    in.refuse(fmt::format("is \"{}{}\"; expected a text with three coordinates: export it again", name, in.line()));
  if (in.line().find_first_not_of(" \t") == std::string_view::npos) in.next_line();
}

void add_face(OffText& in, std::size_t face, const std::vector<Eigen::Vector3d>& vertices, RawSurface& surface) {
  const auto corners = in.number<std::int64_t>("a number of corners");
  if (corners < 1) in.refuse(fmt::format("face {} has {} corners; expected at least one", face, corners));
  std::vector<Eigen::Vector3d> polygon;
  for (std::int64_t k = 0; k < corners; ++k) {
    const auto v = in.number<std::int64_t>("a corner");
    if (v < 0 || v >= static_cast<std::int64_t>(vertices.size()))
      in.refuse(fmt::format("face {} names vertex {} of {}; expected a whole file", face, v, vertices.size()));
    polygon.push_back(vertices[static_cast<std::size_t>(v)]);
  }
  if (corners < 3) ++surface.skipped;
  for (const auto& triangle : triangulated(polygon))
    for (const std::size_t k : triangle) surface.corners.push_back(polygon[k]);
}

}  // namespace

RawSurface read_off(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  OffText in(path, std::string(std::istreambuf_iterator<char>(file), {}));
  pass_header(in);
  const std::size_t vertices = in.count("its number of vertices"), faces = in.count("its number of faces");
  std::vector<Eigen::Vector3d> points;
  while (points.size() < vertices) {
    if (!in.next_line()) in.cut_short(vertices, "vertices", points.size());
    points.emplace_back();
    for (double& x : points.back()) x = in.number<double>("a coordinate");
  }
  RawSurface surface;
  for (std::size_t face = 0; face < faces; ++face) {
    if (!in.next_line()) in.cut_short(faces, "faces", face);
    add_face(in, face, points, surface);
  }
  return surface;
}

}  // namespace ostium::vascular
