#pragma once
/// Closed surfaces from formulas.
#include <functional>

#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

double signed_power(double x, double e);  ///< |x|^e with the sign of x

/// |x/a|^e + |y/b|^e + |z/c|^e = 1 about `middle`, turned by `axes`; e = 2: an ellipsoid, larger: rounder boxes.
Mesh superellipsoid(const Eigen::Vector3d& middle, const Eigen::Vector3d& half_axes, double exponent,
                    const Eigen::Matrix3d& axes = Eigen::Matrix3d::Identity(), int rows = 20);

/// An ellipse swept along `line` (no two neighbours equal), with round ends; `tall` is its half axis along `up`,
/// `thick` the other one. The second version takes both per point.
Mesh swept_ellipse(const std::vector<Eigen::Vector3d>& line, double tall, double thick, const Eigen::Vector3d& up);
Mesh swept_ellipse(const std::vector<Eigen::Vector3d>& line, const std::vector<Eigen::Vector2d>& tall_thick,
                   const Eigen::Vector3d& up);

/// A straight rod of `sides` flat sides with pointed ends, which encloses the round rod's volume.
Mesh rod(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double radius_a, double radius_b, int sides);
/// The same along several points.
Mesh rod(const std::vector<Eigen::Vector3d>& line, const std::vector<double>& radius, int sides);

/// The surface of {inside < 0}, by surface nets with cells of `cell_m` (Gibson, MERL 1999); `inside` must be positive
/// on the box's boundary.
Mesh surface_net(const std::function<double(const Eigen::Vector3d&)>& inside, const Eigen::Vector3d& low,
                 const Eigen::Vector3d& high, double cell_m);

/// Smooth minimum of two distances; fills the crevice between them over about `k`.
double joined(double a, double b, double k);
/// Distance of p to a round rod of varying thickness; negative inside.
double from_rod(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b, double radius_a,
                double radius_b);

}  // namespace ostium::vascular
