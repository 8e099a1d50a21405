#pragma once
/// Closed surfaces from formulas.
#include <functional>

#include "vascular/mesh.h"

namespace ostium {

/// |x/a|^e + |y/b|^e + |z/c|^e = 1 about `middle`, turned by `axes`; e = 2: an ellipsoid, larger: rounder boxes.
Mesh superellipsoid(const Eigen::Vector3d& middle, const Eigen::Vector3d& half_axes, double exponent,
                    const Eigen::Matrix3d& axes = Eigen::Matrix3d::Identity(), int rows = 20);

/// An ellipse swept along `line` (neighbours apart), with round ends; `tall` is its half axis along `up`, `thick`
/// across.
Mesh swept_ellipse(const std::vector<Eigen::Vector3d>& line, double tall, double thick, const Eigen::Vector3d& up);

/// Where `inside` is negative, by surface nets on cells of `cell_m` (Gibson, MERL 1999); `inside` is positive at the
/// border of the box.
Mesh surface_net(const std::function<double(const Eigen::Vector3d&)>& inside, const Eigen::Vector3d& low,
                 const Eigen::Vector3d& high, double cell_m);

}  // namespace ostium
