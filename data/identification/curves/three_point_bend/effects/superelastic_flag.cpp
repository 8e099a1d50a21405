/// Nitinol transforms beyond a strain of about 1 % and back at a lower stress: a plateau there and a lower one back
/// (Auricchio's flag, section.h).
#include <algorithm>

#include "data/identification/curves/three_point_bend/three_point_bend.h"

namespace ostium::data::three_point_bend {

Effect superelastic_flag() {
  Effect effect;
  effect.head.id = "superelastic_flag";
  effect.head.what = "a superelastic plateau, lower on the way back";
  effect.head.parameters = {
      {"curvature_per_mm", "1/mm", "curvature at which transformation begins", 0.02, 0.8, 5e-4, 0.5, true},
      {"back", "1", "moment at which it ends on the way back, against that", 0.6, 0.2, 0.05, 0.98, false},
      {"stiffness_lost", "1", "share of the stiffness that is lost on the plateau", 0.7, 0.3, 0, 0.99, false}};
  effect.apply = [](const std::vector<double>& v, Setup& setup) { setup.section.flag = {v[0] / 1e-3, v[1], 1 - v[2]}; };
  effect.adapt = [](const Setup& declared, std::vector<EffectParameter>& p) {
    // What gives way below a strain of 0.2 % at the surface slips (coil_core_slip.cpp).
    p[0].least = 0.002 / (declared.radius_m / 1e-3);
    p[0].prior = std::max(p[0].prior, 1.5 * p[0].least);
  };
  return effect;
}

}  // namespace ostium::data::three_point_bend
