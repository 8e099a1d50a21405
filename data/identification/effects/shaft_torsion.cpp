/// Twist of the straight shafts between the drives and the base: a shaft of GJ and length l turns by `compliance` T l /
/// GJ under the torque T. 0: rigid, as a set declares; 1: as its own sections give.
#include "data/identification/effects/tools.h"

namespace ostium::data {

namespace shaft_torsion_parts {

std::string why_not(const MeasurementSet& set, std::optional<int> instrument) {
  if (set.vessel) return "in a vessel shafts are not modelled";
  for (const Experiment& e : set.experiments)
    for (std::size_t i = 0; i < e.set.size(); ++i)
      if (chosen(instrument, i) && e.set[i].shaft_m > 0) return "";
  return "no experiment gives shaft_mm";
}

/// Twist per torque of the stretch of an instrument proximal to `from_m` from its tip.
double twist_per_torque(const std::vector<core::Section>& sections, double from_m, double length_m) {
  double sum = 0;
  for (const core::Section& s : sections) {
    const double from = std::max(from_m, s.from_tip_m), to = std::min(from_m + length_m, s.to_tip_m);
    if (to > from) sum += (to - from) / s.GJ_N_m2;
  }
  return sum;
}

void apply(const ActiveEffect& effect, const MeasurementSet&, const Experiment& e, ExperimentSetup& setup) {
  for (std::size_t i = 0; i < e.set.size(); ++i) {
    if (!chosen(effect.instrument, i)) continue;
    core::ConcentricPart& part = setup.nest.parts[i];
    part.shaft_rad_per_Nm = effect.values[0] * twist_per_torque(part.sections, e.set[i].inserted_m, e.set[i].shaft_m);
  }
}

}  // namespace shaft_torsion_parts

Effect shaft_torsion() {
  using namespace shaft_torsion_parts;
  Effect effect;
  effect.id = "shaft_torsion";
  effect.what = "twist of the shafts behind the base";
  effect.parameters = {{"compliance", "1", "twist of the shafts against what their GJ says", 1, 1, 0, 10, false}};
  effect.why_not = why_not, effect.apply = apply;
  effect.of_one_instrument = true;
  return effect;
}

}  // namespace ostium::data
