#pragma once
/// What is wrong with a surface: whether it is closed, faces outwards and does not cross itself, and where not.
///
/// Everything that moves inside a surface needs it closed and facing outwards: inside and outside, path lengths of
/// X-rays, volumes. Triangles face outwards when they run counter-clockwise as seen from outside.
#include <array>
#include <string>
#include <vector>

#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

/// One kind of fault: how often, and where the first ones are.
struct SurfaceFault {
  int count = 0;
  std::vector<Eigen::Vector3d> where;  ///< patient frame; at most `places_kept`
  static constexpr std::size_t places_kept = 16;
  void add(const Eigen::Vector3d& p);
};

struct SurfaceReport {
  int vertices = 0, triangles = 0, components = 0;
  double volume_m3 = 0, area_m2 = 0;
  SurfaceFault open_edges;        ///< edges of one triangle only: a hole
  SurfaceFault branching_edges;   ///< edges of more than two triangles: walls that meet inside
  SurfaceFault flipped_edges;     ///< edges whose two triangles face opposite ways
  SurfaceFault pinched_vertices;  ///< vertices in which two sheets touch
  SurfaceFault slivers;           ///< triangles without area
  SurfaceFault inverted;          ///< closed components that face inwards; their first vertex
  SurfaceFault crossings;         ///< pairs of triangles that cross

  bool closed() const { return !open_edges.count && !branching_edges.count && !flipped_edges.count; }
  /// Closed, facing outwards, crossing nothing.
  bool sound() const;
};

/// Components inside others (a cavity) may face inwards only if `cavities`.
SurfaceReport check_surface(const Mesh& mesh, bool cavities = false);

/// Pairs of triangles that cross each other. Sharing a vertex or touching is no crossing.
std::vector<std::array<int, 2>> crossing_triangles(const Mesh& mesh);

/// One line a fault, in millimetres, with its first place; "sound" if there is none.
std::string describe(const SurfaceReport& report);

}  // namespace ostium::vascular
