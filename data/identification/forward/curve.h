#pragma once
/// Measurements of curves given by points.
#include <Eigen/Core>
#include <vector>

namespace ostium::data {

/// Nearest point of the curve, continued straight past its ends.
Eigen::Vector3d nearest_point(const std::vector<Eigen::Vector3d>& curve, const Eigen::Vector3d& p);
/// The same for many, which come in the curve's order, one after the other; any order will do.
std::vector<Eigen::Vector3d> nearest_points(const std::vector<Eigen::Vector3d>& curve,
                                            const std::vector<Eigen::Vector3d>& many);

/// Radius of the circle that fits the curve best (least squares in its plane); infinite for a straight one.
double radius_of_curvature(const std::vector<Eigen::Vector3d>& curve);

}  // namespace ostium::data
