#pragma once
/// A triangle mesh, read from and written to files.
#include <Eigen/Core>
#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include "vascular/geometry/mesh/length_unit.h"

namespace ostium::vascular {

struct Mesh {
  std::vector<Eigen::Vector3d> vertices;      ///< patient frame, metres
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise as seen from outside
};

/// A mesh that cannot be read, written or used. The message names the file, the fault and the remedy.
struct MeshError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct MeshFile {
  Mesh mesh;
  int welded_vertices = 0;    ///< corners merged with an earlier one, beyond exact copies
  int dropped_triangles = 0;  ///< those with two corners merged
  int skipped_faces = 0;      ///< points and lines
};

/// Corners closer than this are merged into one vertex.
constexpr double default_weld_m = 1e-6;

/// Reads the formats of mesh_files/formats.h: VTK's surfaces and, by assimp, STL, PLY, OBJ, glTF and a few more; all
/// parts become one mesh, axes are kept. Throws MeshError, and nothing else, if the file cannot be read, is cut short,
/// has no triangle or more than a limit, or contains a non-finite number.
MeshFile read_mesh(const std::string& path, LengthUnit unit, double weld_m = default_weld_m);

/// One shape in several positions: every file must have the same triangles in the same order. The first file decides
/// which corners are merged. Also throws MeshError if a file has a different number of triangles, or different ones,
/// naming the file and the numbers.
std::vector<Mesh> read_mesh_sequence(const std::vector<std::string>& paths, LengthUnit unit,
                                     double weld_m = default_weld_m);

/// The bytes of a file: .obj, .stl or .ply, by the name's ending, in single precision as these formats have it. Throws
/// MeshError for another ending. (data/formats/mesh_writer.h writes it.)
std::string mesh_bytes(const std::string& path, const Mesh& mesh, LengthUnit unit);

/// Merges corners within `weld_m` of each other. `corners` holds three points per triangle; returns the vertex index of
/// each, numbered by first appearance.
std::vector<int> weld(const std::vector<Eigen::Vector3d>& corners, double weld_m);

/// Middle of the bounding box: an origin for sums over a mesh, which about one kilometres away would cancel to nothing
/// but rounding.
Eigen::Vector3d box_middle(const Mesh& mesh);
/// Signed volume in m3: positive if the triangles face outwards.
double volume_m3(const Mesh& mesh);
double area_m2(const Mesh& mesh);
/// Generalised winding number of a point: 1 inside a closed mesh that faces outwards, 0 outside. O(#triangles).
double winding_number(const Mesh& mesh, const Eigen::Vector3d& p);

/// Appends `b` to `a`.
void append(Mesh& a, const Mesh& b);

}  // namespace ostium::vascular
