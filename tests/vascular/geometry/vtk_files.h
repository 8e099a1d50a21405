#pragma once
/// A cube in VTK's files, in each of their encodings: two triangles, a quad, a strip of eight triangles, and beside
/// them a point and a line.
#include <zlib.h>

#include <array>
#include <bit>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

namespace ostium::test {

/// Exact in single precision, so that all encodings bring back the same numbers.
constexpr double vtk_edge = 10.25;

struct VtkEncoding {
  std::string format = "ascii";  ///< ascii, binary or appended
  bool base64 = false;           ///< appended data only
  bool zlib = false, big_endian = false;
  bool wide = false;  ///< headers and indices of 64 bits, points in double precision
};

inline const std::array<std::vector<std::int64_t>, 6> vtk_cells = {
    {{0, 2, 1}, {1, 2, 3}, {4, 5, 7, 6}, {4, 0, 5, 1, 7, 3, 6, 2, 4, 0}, {3}, {0, 7}}};
inline const std::array<int, 6> vtk_types = {5, 5, 9, 6, 1, 3};

inline std::vector<double> vtk_coordinates() {
  std::vector<double> all;
  for (int i = 0; i < 8; ++i)
    for (int k = 0; k < 3; ++k) all.push_back(vtk_edge * (i >> k & 1));
  return all;
}

inline std::string bytes_of(std::uint64_t bits, int size, bool big_endian) {
  std::string bytes;
  for (int k = 0; k < size; ++k) bytes += static_cast<char>(bits >> 8 * (big_endian ? size - 1 - k : k) & 0xff);
  return bytes;
}

inline std::string bytes_of(double value, bool wide, bool big_endian) {
  return wide ? bytes_of(std::bit_cast<std::uint64_t>(value), 8, big_endian)
              : bytes_of(std::bit_cast<std::uint32_t>(static_cast<float>(value)), 4, big_endian);
}

inline std::string base64_of(const std::string& bytes) {
  const char* letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (at + k < bytes.size() ? static_cast<unsigned char>(bytes[at + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += at + k > bytes.size() ? '=' : letters[bits >> (18 - 6 * k) & 63];
  }
  return text;
}

/// Header and data. Blocks are short, so that there are several, and the last is not full.
inline std::array<std::string, 2> vtk_packed(const std::string& bytes, const VtkEncoding& encoding) {
  const auto number = [&](std::size_t n) {
    return bytes_of(std::uint64_t{n}, encoding.wide ? 8 : 4, encoding.big_endian);
  };
  if (!encoding.zlib) return {number(bytes.size()), bytes};
  constexpr std::size_t block = 24;
  std::string sizes, data;
  for (std::size_t at = 0; at < bytes.size(); at += block) {
    const std::string part = bytes.substr(at, block);
    std::vector<Bytef> packed(compressBound(part.size()));
    uLongf size = packed.size();
    compress(packed.data(), &size, reinterpret_cast<const Bytef*>(part.data()), part.size());
    sizes += number(size);
    data.append(reinterpret_cast<const char*>(packed.data()), size);
  }
  return {number((bytes.size() + block - 1) / block) + number(block) + number(bytes.size() % block) + sizes, data};
}

/// Writes arrays one after another, and keeps what has to be appended.
class VtkXmlWriter {
 public:
  explicit VtkXmlWriter(const VtkEncoding& encoding) : encoding_(encoding) {}

  std::string points() {
    std::string text, bytes;
    for (double x : vtk_coordinates()) {
      text += std::to_string(x) + ' ';
      bytes += bytes_of(x, encoding_.wide, encoding_.big_endian);
    }
    return "<Points>" + array("Points", encoding_.wide ? "Float64" : "Float32", text, bytes) + "</Points>\n";
  }

  std::string integers(const std::string& name, const std::vector<std::int64_t>& values) {
    std::string text, bytes;
    for (std::int64_t v : values) {
      text += std::to_string(v) + '\n';
      bytes += bytes_of(static_cast<std::uint64_t>(v), encoding_.wide ? 8 : 4, encoding_.big_endian);
    }
    return array(name, encoding_.wide ? "Int64" : "Int32", text, bytes);
  }

  /// The cells from `first` to before `last`.
  std::string cells(std::size_t first, std::size_t last) {
    std::vector<std::int64_t> connectivity, ends;
    for (std::size_t c = first; c < last; ++c) {
      connectivity.insert(connectivity.end(), vtk_cells[c].begin(), vtk_cells[c].end());
      ends.push_back(static_cast<std::int64_t>(connectivity.size()));
    }
    return integers("connectivity", connectivity) + integers("offsets", ends);
  }

  std::string file(const std::string& type, const std::string& piece) const {
    return "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + type + "\" version=\"1.0\" byte_order=\"" +
           (encoding_.big_endian ? "BigEndian" : "LittleEndian") + "\" header_type=\"" +
           (encoding_.wide ? "UInt64" : "UInt32") + "\"" +
           (encoding_.zlib ? " compressor=\"vtkZLibDataCompressor\"" : "") + ">\n<" + type + ">\n" + piece + "</" +
           type + ">\n" +
           (encoding_.format == "appended"
                ? std::string("<AppendedData encoding=\"") + (encoding_.base64 ? "base64" : "raw") + "\">\n   _" +
                      appended_ + "\n</AppendedData>\n"
                : "") +
           "</VTKFile>\n";
  }

 private:
  std::string array(const std::string& name, const std::string& type, const std::string& text,
                    const std::string& bytes) {
    std::string content = text, where;
    if (encoding_.format != "ascii") {
      const auto [header, data] = vtk_packed(bytes, encoding_);
      const bool raw = encoding_.format == "appended" && !encoding_.base64;
      content = raw ? header + data : encoding_.zlib ? base64_of(header) + base64_of(data) : base64_of(header + data);
    }
    if (encoding_.format == "appended") {
      where = " offset=\"" + std::to_string(appended_.size()) + "\"";
      appended_ += content;
      content.clear();
    }
    return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
           (name == "Points" ? "3" : "1") + "\" format=\"" + encoding_.format + "\"" + where + ">\n  " + content +
           "\n</DataArray>\n";
  }

  VtkEncoding encoding_;
  std::string appended_;
};

inline std::string vtp(const VtkEncoding& encoding) {
  VtkXmlWriter to(encoding);
  std::string piece =
      "<Piece NumberOfPoints=\"8\" NumberOfVerts=\"1\" NumberOfLines=\"1\" NumberOfStrips=\"1\" NumberOfPolys=\"3\">\n";
  piece += to.points();
  piece += "<Verts>" + to.cells(4, 5) + "</Verts>\n<Lines>" + to.cells(5, 6) + "</Lines>\n";
  piece += "<Strips>" + to.cells(3, 4) + "</Strips>\n<Polys>" + to.cells(0, 3) + "</Polys>\n</Piece>\n";
  return to.file("PolyData", piece);
}

inline std::string vtu(const VtkEncoding& encoding, std::vector<int> types = {vtk_types.begin(), vtk_types.end()}) {
  VtkXmlWriter to(encoding);
  std::string piece = "<Piece NumberOfPoints=\"8\" NumberOfCells=\"6\">\n";
  piece += to.points();
  piece += "<Cells>" + to.cells(0, 6) + to.integers("types", {types.begin(), types.end()}) + "</Cells>\n</Piece>\n";
  return to.file("UnstructuredGrid", piece);
}

/// Legacy files: numbers as words, or big-endian.
class VtkLegacyWriter {
 public:
  VtkLegacyWriter(bool binary, const std::string& version) : binary_(binary), new_(version[0] == '5') {
    text_ = "# vtk DataFile Version " + version + "\nA cube\n" + (binary ? "BINARY" : "ASCII") + "\n";
  }

  std::string file(bool grid) {
    text_ += grid ? "DATASET UNSTRUCTURED_GRID\n" : "DATASET POLYDATA\n";
    // What 3D Slicer and VTK put there, too.
    text_ += "FIELD FieldData 1\nTime 1 2 double\n", reals({0.5, 1.5});
    text_ += "POINTS 8 float\n", reals(vtk_coordinates(), false);
    text_ += "METADATA\nINFORMATION 1\nNAME L2_NORM_RANGE LOCATION vtkDataArray\nDATA 2 0 1 \n\n";
    if (grid) {
      cells("CELLS", 0, 6);
      text_ += "CELL_TYPES 6\n", integers({vtk_types.begin(), vtk_types.end()}, 4);
    } else {
      cells("VERTICES", 4, 5), cells("LINES", 5, 6), cells("POLYGONS", 0, 3), cells("TRIANGLE_STRIPS", 3, 4);
    }
    return text_ + "POINT_DATA 8\nSCALARS radius float 1\nLOOKUP_TABLE default\n";
  }

 private:
  void reals(const std::vector<double>& values, bool wide = true) {
    for (double v : values) text_ += binary_ ? bytes_of(v, wide, true) : std::to_string(v) + ' ';
    text_ += '\n';
  }

  void integers(const std::vector<std::int64_t>& values, int size) {
    for (std::int64_t v : values)
      text_ += binary_ ? bytes_of(static_cast<std::uint64_t>(v), size, true) : std::to_string(v) + ' ';
    text_ += '\n';
  }

  void cells(const std::string& name, std::size_t first, std::size_t last) {
    std::vector<std::int64_t> connectivity, offsets = {0}, counted;
    for (std::size_t c = first; c < last; ++c) {
      counted.push_back(static_cast<std::int64_t>(vtk_cells[c].size()));
      counted.insert(counted.end(), vtk_cells[c].begin(), vtk_cells[c].end());
      connectivity.insert(connectivity.end(), vtk_cells[c].begin(), vtk_cells[c].end());
      offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
    }
    const std::size_t a = new_ ? offsets.size() : last - first, b = new_ ? connectivity.size() : counted.size();
    text_ += name + ' ' + std::to_string(a) + ' ' + std::to_string(b) + '\n';
    if (!new_) return integers(counted, 4);
    // As VTK writes them on this machine, and with ids of 32 bits.
    const int size = name == "LINES" ? 4 : 8;
    const std::string type = " vtktypeint" + std::to_string(8 * size) + "\n";
    text_ += "OFFSETS" + type, integers(offsets, size);
    text_ += "CONNECTIVITY" + type, integers(connectivity, size);
  }

  bool binary_, new_;
  std::string text_;
};

}  // namespace ostium::test
