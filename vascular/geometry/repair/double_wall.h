#pragma once
/// Vessels that were drawn or segmented with a thick wall: two shells, of which the lumen needs the inner one.
#include "vascular/geometry/repair/sheets.h"

namespace ostium::vascular {

struct DoubleWall {
  std::vector<bool> outer;                          ///< of each triangle: part of an outer shell
  int triangles = 0;                                ///< so many are
  double thickness_m = 0;                           ///< median distance of the shells
  Eigen::Vector3d where = Eigen::Vector3d::Zero();  ///< the first of them
};

/// A triangle is of an outer shell if there is nothing near on one side, and on the other, within 5 mm, another shell
/// that is not reached along the surface, with a wider room (the lumen) behind it. Patches of them count, not single
/// ones.
DoubleWall find_double_wall(const Mesh& mesh, const Sheets& sheets);

}  // namespace ostium::vascular
