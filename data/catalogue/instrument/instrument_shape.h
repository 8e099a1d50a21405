#pragma once
/// The unloaded shape of an instrument's distal end, as a row of straight pieces and arcs.
#include <vector>

#include "core/material/section.h"

namespace ostium::data {

/// A piece of the shape, uniform in curvature. SI.
struct ShapePiece {
  double length_m = 0;  ///< along the centreline; > 0
  double radius_m = 0;  ///< of the arc; 0 where straight
  /// Towards which side the arc bends on the way from base to tip: 0 to director d1, pi / 2 to d2. Directors are those
  /// of the unbent instrument, carried along without twist.
  double plane_rad = 0;
};

double length_of(const std::vector<ShapePiece>& pieces);

/// Rest curvature of one piece, 1/m: (-sin plane, cos plane, 0) / radius, because u1 > 0 turns d3 towards -d2 and
/// u2 > 0 turns it towards d1 (core/rod/section.h).
Eigen::Vector3d rest_curvature(const ShapePiece& piece);

/// `sections` with the rest curvature of `pieces`, which begin at the tip and go backwards; sections are cut where a
/// piece ends, and keep their own curvature behind the last piece. The pieces must not be longer than the sections.
std::vector<core::Section> bent(const std::vector<core::Section>& sections, const std::vector<ShapePiece>& pieces);

}  // namespace ostium::data
