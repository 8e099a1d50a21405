#pragma once
/// Rods for tests of instruments that run in each other.
#include "core/material/section.h"

namespace ostium::core {

/// Of one stiffness, straight, damped a little.
inline RodDescription plain_rod(double length_m, double EI_N_m2, double radius_m, double bore_m, int elements) {
  RodDescription d;
  d.name = "rod";
  Section s;
  s.to_tip_m = length_m;
  s.EI1_N_m2 = s.EI2_N_m2 = EI_N_m2;
  s.GJ_N_m2 = EI_N_m2 / 1.3;
  s.kg_per_m = 4e-3;
  s.radius_m = radius_m, s.inner_radius_m = bore_m;
  d.sections = {s};
  d.element_lengths_m = equal_elements(d.sections, elements);
  d.damping = {0.007, 0.0035, 1e-3};
  return d;
}

/// The same with its last 40 mm curved.
inline RodDescription hooked(RodDescription d, const Eigen::Vector3d& curvature_per_m) {
  Section tip = d.sections[0];
  tip.to_tip_m = 0.04, tip.rest_curvature_per_m = curvature_per_m;
  d.sections[0].from_tip_m = 0.04;
  d.sections.insert(d.sections.begin(), tip);
  return d;
}

}  // namespace ostium::core
