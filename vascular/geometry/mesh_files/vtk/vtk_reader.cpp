#include <filesystem>
#include <fstream>

#include "vascular/geometry/mesh/mesh.h"
#include "vascular/geometry/mesh_files/raw_surface.h"
#include "vascular/geometry/mesh_files/vtk/vtk_legacy.h"
#include "vascular/geometry/mesh_files/vtk/vtk_xml.h"

namespace ostium::vascular {

namespace {

std::string whole(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text(std::filesystem::file_size(path), '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!file) throw MeshError(path + ": cannot be read to its end; is it yours to read, and the disk in order?");
  return text;
}

}  // namespace

RawSurface read_vtk(const std::string& path) {
  const std::string text = whole(path);
  return text.starts_with('#') ? read_vtk_legacy(path, text) : read_vtk_xml(path, text);
}

std::string read_vtk_field(const std::string& path, const char* name) { return vtk_xml_field(path, whole(path), name); }

}  // namespace ostium::vascular
