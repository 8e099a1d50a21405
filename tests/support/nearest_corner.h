#pragma once
/// Distance from a point to the nearest of a wall's corners in its current pose.
#include <algorithm>

#include "core/math/field.h"

namespace ostium::test {

inline double nearest_corner_m(const core::Field<3>& corners, const Eigen::Vector3d& p_W) {
  double nearest_m = 1;
  for (int i = 0; i < corners.size(); ++i) nearest_m = std::min(nearest_m, (corners[i] - p_W).norm());
  return nearest_m;
}

}  // namespace ostium::test
