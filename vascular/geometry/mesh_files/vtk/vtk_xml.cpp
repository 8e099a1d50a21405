#include "vascular/geometry/mesh_files/vtk/vtk_xml.h"

#include <fmt/format.h>

#include <pugixml.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include "vascular/geometry/mesh/mesh.h"
#include "vascular/geometry/mesh_files/vtk/vtk_bytes.h"
#include "vascular/geometry/mesh_files/vtk/vtk_cells.h"
#include "vascular/geometry/mesh_files/vtk/vtk_numbers.h"

namespace ostium::vascular {

namespace {

constexpr std::string_view again = "expected a whole file, copy or export it again";

class VtkXml {
 public:
  VtkXml(const std::string& path, const std::string& text) : path_(path) {
    parse(text);
    read_header();
  }

  RawSurface read() {
    const pugi::xml_node data = file_.child(grid_ ? "UnstructuredGrid" : "PolyData");
    RawSurface surface;
    for (const pugi::xml_node& piece : data.children("Piece")) {
      if (grid_)
        add_grid(piece, surface);
      else
        add_polydata(piece, surface);
    }
    return surface;
  }

  /// Of the texts that stand beside the surface: bytes, the last of them zero.
  std::string field_text(const char* name) const {
    const pugi::xml_node array = file_.first_child().child("FieldData").find_child_by_attribute("Array", "Name", name);
    if (!array) return "";
    const std::string_view format = array.attribute("format").value();
    std::string text;
    if (format == "binary" || format == "appended")
      text = bytes_of(array, fmt::format("{}: FieldData \"{}\"", path_, name), format);
    else
      for (const std::int64_t code : numbers<std::int64_t>(array, "FieldData")) text += static_cast<char>(code);
    return text.substr(0, text.find('\0'));
  }

 private:
  /// Appended data may be raw bytes, which are no XML: the part before them is closed and parsed, they are kept apart.
  void parse(const std::string& text) {
    const std::string::size_type begin = text.find("<AppendedData");
    xml_ = text.substr(0, begin);
    if (begin != std::string::npos) {
      const std::string::size_type end = text.find('>', begin), data = text.find('_', end);
      if (data == std::string::npos)
        throw MeshError(fmt::format("{}: is cut short where its appended data begin; {}", path_, again));
      appended_base64_ = std::string_view(text).substr(begin, end - begin).find("base64") != std::string_view::npos;
      appended_ = std::string_view(text).substr(data + 1);
      if (appended_base64_) appended_ = appended_.substr(0, appended_.find('<'));
      xml_ += "</VTKFile>";
    }
    if (const pugi::xml_parse_result result = document_.load_buffer_inplace(xml_.data(), xml_.size()); !result)
      throw MeshError(fmt::format("{}: is no whole XML, from byte {} of {} on: {}; {}", path_, result.offset,
                                  text.size(), result.description(), again));
    file_ = document_.child("VTKFile");
  }

  void read_header() {
    const std::string type = file_.attribute("type").value();
    grid_ = type == "UnstructuredGrid";
    if (!grid_ && type != "PolyData")
      throw MeshError(fmt::format("{}: holds {}; expected VTK's PolyData or UnstructuredGrid: save the surface as .vtp",
                                  path_, type.empty() ? "no VTKFile" : "VTK's " + type));
    encoding_.big_endian = std::string_view(file_.attribute("byte_order").value()) == "BigEndian";
    encoding_.header_bytes = std::string_view(file_.attribute("header_type").value()) == "UInt64" ? 8 : 4;
    const std::string_view compressor = file_.attribute("compressor").value();
    encoding_.zlib = compressor == "vtkZLibDataCompressor";
    if (!encoding_.zlib && !compressor.empty())
      throw MeshError(fmt::format("{}: is compressed by {}; expected vtkZLibDataCompressor or none: save it again so",
                                  path_, compressor));
  }

  std::uint64_t count(const pugi::xml_node& piece, const char* name) const {
    const std::string_view value = piece.attribute(name).value();
    if (value.empty()) return 0;
    const auto number = vtk_number<std::int64_t>(value);
    if (!number || *number < 0)
      throw MeshError(fmt::format("{}: {} is \"{}\"; expected a whole number from 0 on", path_, name, value));
    return static_cast<std::uint64_t>(*number);
  }

  std::string bytes_of(const pugi::xml_node& array, const std::string& where, std::string_view format) const {
    const bool inside = format == "binary";
    std::string_view text = inside ? array.child_value() : appended_;
    if (!inside) {
      const std::uint64_t offset = count(array, "offset");
      if (offset >= text.size())
        throw MeshError(fmt::format("{} is cut short: it begins at byte {} of {} that are appended; {}", where, offset,
                                    text.size(), again));
      text.remove_prefix(offset);
    }
    VtkBytes bytes(where, text, inside || appended_base64_);
    return vtk_array(bytes, encoding_);
  }

  template <class N>
  std::vector<N> numbers(const pugi::xml_node& array, const char* group) const {
    const std::string where = fmt::format("{}: {} \"{}\"", path_, group, array.attribute("Name").value());
    const std::string_view format = array.attribute("format").value();
    if (format == "ascii" || format.empty()) {
      std::vector<N> all;
      std::string_view text = array.child_value();
      for (std::string_view word = take_word(text); !word.empty(); word = take_word(text)) {
        const auto number = vtk_number<N>(word);
        if (!number) throw MeshError(fmt::format("{} has \"{}\" where a number should be; {}", where, word, again));
        all.push_back(*number);
      }
      return all;
    }
    const std::string type = array.attribute("type").value();
    const auto known = vtk_type(type);
    if (!known || (format != "binary" && format != "appended"))
      throw MeshError(
          fmt::format("{} has the type \"{}\" and the format \"{}\"; expected numbers in ascii, binary or "
                      "appended",
                      where, type, format));
    const std::string bytes = bytes_of(array, where, format);
    if (bytes.size() % size_of(*known))
      throw MeshError(fmt::format("{} has {} bytes, which are no {}; {}", where, bytes.size(), type, again));
    return vtk_numbers<N>(bytes, *known, encoding_.big_endian);
  }

  std::vector<Eigen::Vector3d> points_of(const pugi::xml_node& piece) const {
    const pugi::xml_node array = piece.child("Points").child("DataArray");
    return vtk_points(path_, array ? numbers<double>(array, "Points") : std::vector<double>(),
                      count(piece, "NumberOfPoints"));
  }

  /// Without `types`, which PolyData has not.
  VtkCells cells_of(const pugi::xml_node& piece, const char* group, const char* number) const {
    const auto whole = [&](const char* name) {
      const pugi::xml_node array = piece.child(group).find_child_by_attribute("DataArray", "Name", name);
      return array ? numbers<std::int64_t>(array, group) : std::vector<std::int64_t>();
    };
    VtkCells cells{group, whole("connectivity"), whole("offsets"), whole("types")};
    const std::uint64_t promised = count(piece, number);
    // VTK's own arrays begin with a zero, and some programs write that too.
    if (cells.ends.size() == promised + 1 && cells.ends.front() == 0) cells.ends.erase(cells.ends.begin());
    if (cells.ends.size() != promised)
      throw MeshError(
          fmt::format("{}: {} is {}, and {} offsets are there; {}", path_, number, promised, cells.ends.size(), again));
    return cells;
  }

  void add_polydata(const pugi::xml_node& piece, RawSurface& surface) const {
    const std::vector<Eigen::Vector3d> points = points_of(piece);
    struct Group {
      const char *name, *number;
      std::int64_t type;
    };
    for (const Group& group :
         {Group{"Verts", "NumberOfVerts", vtk_cell::vertices}, Group{"Lines", "NumberOfLines", vtk_cell::line},
          Group{"Strips", "NumberOfStrips", vtk_cell::strip}, Group{"Polys", "NumberOfPolys", vtk_cell::polygon}}) {
      VtkCells cells = cells_of(piece, group.name, group.number);
      cells.types = {group.type};
      add_cells(path_, points, cells, surface);
    }
  }

  void add_grid(const pugi::xml_node& piece, RawSurface& surface) const {
    const VtkCells cells = cells_of(piece, "Cells", "NumberOfCells");
    if (cells.types.size() != cells.ends.size())
      throw MeshError(
          fmt::format("{}: {} types are there for {} cells; {}", path_, cells.types.size(), cells.ends.size(), again));
    add_cells(path_, points_of(piece), cells, surface);
  }

  const std::string& path_;
  std::string xml_;  ///< which the document's texts are part of
  pugi::xml_document document_;
  pugi::xml_node file_;
  std::string_view appended_;
  bool appended_base64_ = false, grid_ = false;
  VtkEncoding encoding_;
};

}  // namespace

RawSurface read_vtk_xml(const std::string& path, const std::string& text) { return VtkXml(path, text).read(); }

std::string vtk_xml_field(const std::string& path, const std::string& text, const char* name) {
  return VtkXml(path, text).field_text(name);
}

}  // namespace ostium::vascular
