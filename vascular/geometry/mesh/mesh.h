#pragma once
/// A triangle mesh, and its way from and to files (assimp).
#include <Eigen/Core>
#include <array>
#include <stdexcept>
#include <string>
#include <vector>

namespace ostium::vascular {

struct Mesh {
  std::vector<Eigen::Vector3d> vertices;      ///< patient frame, metres
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise as seen from outside
};

/// A mesh that cannot be read, written or used. The message names the file, what is wrong with it and the cure.
struct MeshError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What a number in a file means: metres per unit.
enum class LengthUnit { millimetre, centimetre, metre, inch };
double metres(LengthUnit unit);

struct MeshFile {
  Mesh mesh;
  int welded_vertices = 0;    ///< corners that became one with an earlier one, beyond exact copies
  int dropped_triangles = 0;  ///< those of which two corners became one
  int skipped_faces = 0;      ///< points and lines
};

/// Corners nearer than this are one vertex.
constexpr double default_weld_m = 1e-6;

/// Reads any format of assimp (OBJ, STL, PLY, glTF, Collada, ...); the file's parts become one mesh, axes stay as they
/// are. Throws MeshError if the file cannot be read, holds no triangle, or a number that is not finite.
MeshFile read_mesh(const std::string& path, LengthUnit unit, double weld_m = default_weld_m);

/// The same shape in several positions: file by file the same triangles in the same order. What is welded is decided by
/// the first. Throws MeshError also if a file has another number of triangles, or others, with
/// the file and how many.
std::vector<Mesh> read_mesh_sequence(const std::vector<std::string>& paths, LengthUnit unit,
                                     double weld_m = default_weld_m);

/// Writes .obj, .stl or .ply, by the name's ending, in single precision as these formats have it.
void write_mesh(const std::string& path, const Mesh& mesh, LengthUnit unit);

/// Corners within `weld_m` of each other become one vertex. `corners` holds three points a triangle; the index of each
/// one's vertex is returned, counted in order of first appearance.
std::vector<int> weld(const std::vector<Eigen::Vector3d>& corners, double weld_m);

/// Signed volume in m3: positive if the triangles face outwards.
double volume_m3(const Mesh& mesh);
double area_m2(const Mesh& mesh);
/// Generalised winding number of a point: 1 inside a closed mesh that faces outwards, 0 outside. O(#triangles).
double winding_number(const Mesh& mesh, const Eigen::Vector3d& p);

/// `b` behind `a`, in one mesh.
void append(Mesh& a, const Mesh& b);

}  // namespace ostium::vascular
