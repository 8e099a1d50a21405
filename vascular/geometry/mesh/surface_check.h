#pragma once
/// Checks a surface: is it closed, facing outwards, free of self-crossings, and if not, where.
///
/// Everything that moves inside a surface requires this: inside and outside, X-ray path lengths, volumes. Triangles
/// face outwards if they run counter-clockwise as seen from outside.
#include <array>
#include <string>
#include <vector>

#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

/// One kind of fault: how many, and where the first ones are.
struct SurfaceFault {
  int count = 0;
  std::vector<Eigen::Vector3d> where;  ///< patient frame; at most `places_kept`
  static constexpr std::size_t places_kept = 16;
  void add(const Eigen::Vector3d& p);
};

struct SurfaceReport {
  int vertices = 0, triangles = 0, components = 0;
  double volume_m3 = 0;  ///< signed; what is open counts as under lids
  double area_m2 = 0;
  SurfaceFault open_edges;        ///< edges of one triangle only: a hole
  SurfaceFault branching_edges;   ///< edges of more than two triangles: walls that meet inside
  SurfaceFault flipped_edges;     ///< edges whose two triangles face opposite ways
  SurfaceFault pinched_vertices;  ///< vertices in which two sheets touch
  SurfaceFault slivers;           ///< triangles without area
  SurfaceFault inverted;          ///< closed components that face inwards; `where`: their first vertex
  SurfaceFault crossings;         ///< pairs of triangles that cross

  bool closed() const { return !open_edges.count && !branching_edges.count && !flipped_edges.count; }
  /// Closed, facing outwards, crossing nothing.
  bool sound() const;
};

/// Components inside others (a cavity) may face inwards only if `cavities`.
SurfaceReport check_surface(const Mesh& mesh, bool cavities = false);

/// Pairs of triangles that cross each other, as crossing.h has it. Touching is no crossing.
std::vector<std::array<int, 2>> crossing_triangles(const Mesh& mesh);

/// One line per fault with its first position in mm; "sound" if there is none.
std::string describe(const SurfaceReport& report);

}  // namespace ostium::vascular
