#pragma once
/// Tubes as walls, for the gates and the benchmark: triangles around a centreline.
#include <functional>

#include "core/wall/surface.h"

namespace ostium::core {

/// A point of a centreline with the radius there.
struct TubePoint {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  ///< m
  double radius_m = 0;
};

/// A closed tube along the points with `around` vertices per ring and a fan at either end.
SurfaceDescription tube(const std::vector<TubePoint>& points, int around);

/// An arc of `angle`, rad, about the y axis, between two straight pieces, `spacing_m` apart; starts at the origin along
/// x and turns towards z.
std::vector<TubePoint> bend(double bend_radius_m, double angle, double lead_m, double trail_m, double radius_m,
                            double spacing_m);

}  // namespace ostium::core
