#pragma once
/// Vessels drawn or segmented with a thick wall: two shells, of which the inner one is the lumen.
#include "vascular/geometry/repair/sheets.h"

namespace ostium::vascular {

struct DoubleWall {
  std::vector<bool> outer;                          ///< per triangle: part of an outer shell
  int triangles = 0;                                ///< number of those
  double thickness_m = 0;                           ///< median distance between the shells
  Eigen::Vector3d where = Eigen::Vector3d::Zero();  ///< first one
};

/// A triangle is part of an outer shell if there is nothing close on one side and, within 5 mm on the other, another
/// shell that is not reached along the surface, with a wider space (the lumen) behind it. A shell of its own is nested
/// in the outer one nearly all along; vessels that cross are none. A wall that was drawn as one solid, with rims that
/// join its two sides, may be up to 20 mm thick, with a lumen down to a tenth of that. Only patches count, not single
/// triangles. `mesh` is oriented.
DoubleWall find_double_wall(const Mesh& mesh, const Sheets& sheets);

/// The same mesh without its outer shells, in whatever unit: it is looked at as if it were as long as vessels are. The
/// lumen that is left faces outwards, unlike the inside of a wall that was drawn as one solid.
Mesh without_outer_wall(Mesh mesh);

}  // namespace ostium::vascular
