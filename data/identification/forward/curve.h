#pragma once
/// Geometry of curves given by points.
#include <Eigen/Core>
#include <vector>

namespace ostium::data {

/// Nearest point on the curve, which is extended straight past its ends.
Eigen::Vector3d nearest_point(const std::vector<Eigen::Vector3d>& curve, const Eigen::Vector3d& p);
/// The same for many points; fastest if they are in the curve's order, but any order works.
std::vector<Eigen::Vector3d> nearest_points(const std::vector<Eigen::Vector3d>& curve,
                                            const std::vector<Eigen::Vector3d>& many);

/// Radius of the least-squares circle in the curve's plane; infinite for a straight curve.
double radius_of_curvature(const std::vector<Eigen::Vector3d>& curve);

}  // namespace ostium::data
