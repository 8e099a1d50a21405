#pragma once
/// How much of the view from a point a triangle takes (A. van Oosterom, J. Strackee, IEEE Trans Biomed Eng
/// 1983;30:125). Summed over a closed surface whose triangles point outwards it is 4 pi inside and 0 outside.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

namespace ostium::core {

/// sr, -2 pi to 2 pi; the corners a, b, c are given from the point.
inline double solid_angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

}  // namespace ostium::core
