#pragma once
/// What the reader of one format hands to `read_mesh`, which scales, welds and counts.
#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

namespace ostium::vascular {

struct RawSurface {
  std::vector<Eigen::Vector3d> corners;  ///< three per triangle, in the file's unit
  int skipped = 0;                       ///< points and lines
};

inline constexpr std::uintmax_t longest_mesh_file = 1'000'000'000;  ///< bytes; a scan of a whole body has a tenth
inline constexpr std::size_t most_triangles = 10'000'000;

/// The file at `path`, by its ending (formats.h) and in this process, where a library that reads it may end us by a
/// signal. Throws MeshError, which begins with `path`.
RawSurface read_surface(const std::string& path);

/// From now on `read_mesh` and `read_mesh_sequence` read files with `reader`, until then with read_surface. For the
/// start of a program, before it has threads.
void read_meshes_with(RawSurface (*reader)(const std::string& path));

/// What assimp makes of it. Files that it names are opened only beside it. Throws MeshError.
RawSurface read_assimp(const std::string& path);
/// OFF as a text, with faces of any number of corners; assimp leaves out those of more than nine. Throws MeshError.
RawSurface read_off(const std::string& path);
/// VTK's files, XML or legacy: their first bytes decide, not their ending. Throws MeshError.
RawSurface read_vtk(const std::string& path);
/// The text that stands as `name` beside the surface of an XML file, or nothing. Throws MeshError.
std::string read_vtk_field(const std::string& path, const char* name);

}  // namespace ostium::vascular
