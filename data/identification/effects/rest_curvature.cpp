/// An undeclared permanent set of the shaft: k (material frame) is added to the rest curvature of the whole instrument
/// or of a stretch of it. Wires take a set from being coiled in their hoop or bent over a finger. Law: the rod's own, m
/// = K (u - u_rest - k).
#include "core/base/units.h"
#include "data/identification/effects/tools.h"

namespace ostium::data {

namespace rest_curvature_parts {

using units::mm;

std::string why_not(const MeasurementSet&, std::optional<int>) { return ""; }

void apply(const ActiveEffect& effect, const MeasurementSet&, const Experiment&, ExperimentSetup& setup) {
  const auto& v = effect.values;
  for (std::size_t i = 0; i < setup.nest.parts.size(); ++i)
    if (chosen(effect.instrument, i))
      change_stretch(setup.nest.parts[i].sections, v[2] * mm, v[3] * mm,
                     [&](core::Section& s) { s.rest_curvature_per_m.head<2>() += Eigen::Vector2d(v[0], v[1]) / mm; });
}

}  // namespace rest_curvature_parts

Effect rest_curvature() {
  using namespace rest_curvature_parts;
  Effect effect;
  effect.id = "rest_curvature";
  effect.what = "a set of the shaft";
  effect.parameters = {{"k1_per_mm", "1/mm", "curvature at rest that is added about d1", 0, 0.002, -0.1, 0.1, false},
                       {"k2_per_mm", "1/mm", "curvature at rest that is added about d2", 0, 0.002, -0.1, 0.1, false},
                       {"from_tip_mm", "mm", "where it begins, from the tip", 0, 1, 0, everywhere_mm, false},
                       {"to_tip_mm", "mm", "where it ends, from the tip", everywhere_mm, 1, 0, everywhere_mm, false}};
  effect.why_not = why_not, effect.apply = apply, effect.forms = stretches_of;
  effect.of_one_instrument = true;
  effect.in_instrument = true;
  effect.of_several_stretches = true;
  return effect;
}

}  // namespace ostium::data
