/// Beyond a curvature the wire yields and keeps a set: it meets the roller later on its way back, and in later runs at
/// the same place (Prager's hardening, section.h).
#include <algorithm>

#include "data/identification/curves/three_point_bend/three_point_bend.h"

namespace ostium::data::three_point_bend {

Effect plastic_set() {
  Effect effect;
  effect.head.id = "plastic_set";
  effect.head.what = "a bend that stays (the wire yields)";
  effect.head.parameters = {
      {"curvature_per_mm", "1/mm", "curvature at which the wire yields", 0.02, 0.8, 5e-4, 0.5, true},
      {"stiffness_lost", "1", "share of the stiffness that is lost beyond it", 0.7, 0.3, 0, 0.99, false}};
  effect.apply = [](const std::vector<double>& v, Setup& setup) { setup.section.yield = {v[0] / 1e-3, 1 - v[1]}; };
  effect.adapt = [](const Setup& declared, std::vector<EffectParameter>& p) {
    // No metal of instruments yields below a strain of 0.2 % at its surface; what gives way before slips.
    p[0].least = 0.002 / (declared.radius_m / 1e-3);
    p[0].prior = std::max(p[0].prior, 1.5 * p[0].least);
  };
  return effect;
}

}  // namespace ostium::data::three_point_bend
