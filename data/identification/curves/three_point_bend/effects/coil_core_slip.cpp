/// A coil that grips its core bends with it until it slips: the section is stiffer below a curvature than beyond, and
/// gives back on another line than it came by (Prager's hardening, section.h). The declared stiffness is that beyond.
#include <algorithm>

#include "data/identification/curves/three_point_bend/three_point_bend.h"

namespace ostium::data::three_point_bend {

Effect coil_core_slip() {
  Effect effect;
  effect.head.id = "coil_core_slip";
  effect.head.what = "a coil that slips on its core";
  effect.head.parameters = {
      {"curvature_per_mm", "1/mm", "curvature at which the coil slips", 0.005, 0.8, 1e-4, 0.2, true},
      {"stiffness_lost", "1", "share of the stiffness that is lost when it slips", 0.3, 0.3, 0, 0.99, false}};
  effect.apply = [](const std::vector<double>& v, Setup& setup) {
    setup.section.slip = {v[0] / 1e-3, 1 - v[1]};
    for (double& EI : setup.EI_N_m2) EI /= 1 - v[1];
  };
  effect.adapt = [](const Setup& declared, std::vector<EffectParameter>& p) {
    // Beyond a strain of 0.2 % at the surface it would be yield (plastic_set.cpp).
    p[0].most = 0.002 / (declared.radius_m / 1e-3);
    p[0].prior = std::min(p[0].prior, 0.5 * p[0].most);
  };
  return effect;
}

}  // namespace ostium::data::three_point_bend
