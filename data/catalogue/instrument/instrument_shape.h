#pragma once
/// The unloaded shape of an instrument's distal end, as a sequence of straight pieces and arcs.
#include <vector>

#include "core/material/section.h"

namespace ostium::data {

/// A piece of constant curvature. SI.
struct ShapePiece {
  double length_m = 0;  ///< along the centreline; > 0
  double radius_m = 0;  ///< of the arc; 0 where straight
  /// Direction towards which the arc bends, going from base to tip: 0 is director d1, pi / 2 is d2. The directors are
  /// those of the unbent instrument, transported without twist.
  double plane_rad = 0;
};

double length_of(const std::vector<ShapePiece>& pieces);

/// Rest curvature of one piece, 1/m: (-sin plane, cos plane, 0) / radius, because u1 > 0 turns d3 towards -d2 and u2 >
/// 0 turns it towards d1 (core/material/section.h).
Eigen::Vector3d rest_curvature(const ShapePiece& piece);

/// `sections` with the rest curvature of `pieces`, which start at the tip. Sections are cut where a piece ends;
/// proximal to the last piece they keep their own curvature. The pieces must not be longer than the sections.
std::vector<core::Section> bent(const std::vector<core::Section>& sections, const std::vector<ShapePiece>& pieces);

}  // namespace ostium::data
