/// Part of the commanded roll does not reach the base, as a fraction or as a dead band counted from zero: slip in the
/// drive, play, friction along the shaft.
#include <cmath>

#include "core/base/units.h"
#include "data/identification/effects/tools.h"

namespace ostium::data {

namespace roll_loss_parts {

std::string why_not(const MeasurementSet& set, std::optional<int> instrument) {
  for (const Experiment& e : set.experiments)
    for (std::size_t i = 0; i < e.set.size(); ++i)
      if (chosen(instrument, i) && e.set[i].roll_rad != 0) return "";
  return "nothing was rolled";
}

void apply(const ActiveEffect& effect, const MeasurementSet&, const Experiment&, ExperimentSetup& setup) {
  const double band = effect.values[1] * units::pi / 180;
  for (std::size_t i = 0; i < setup.nest.parts.size(); ++i) {
    if (!chosen(effect.instrument, i)) continue;
    double& roll = setup.nest.parts[i].roll_rad;
    const double own = roll - setup.material_turn_rad;
    roll += std::copysign(std::max(std::fabs(own) - band, 0.0), own) * (1 - effect.values[0]) - own;
  }
}

std::vector<EffectForm> forms(const MeasurementSet&, std::optional<int>) {
  return {{"fraction", {{"dead_band_deg", 0}}}, {"dead band", {{"fraction", 0}}}};
}

}  // namespace roll_loss_parts

Effect roll_loss() {
  using namespace roll_loss_parts;
  Effect effect;
  effect.id = "roll_loss";
  effect.what = "loss of commanded roll";
  effect.parameters = {
      {"fraction", "1", "part of the commanded roll that does not arrive", 0, 0.1, -0.2, 0.8, false},
      {"dead_band_deg", "deg", "of the commanded roll, from zero, that does not arrive", 0, 10, 0, 120, false}};
  effect.why_not = why_not, effect.apply = apply, effect.forms = forms;
  effect.of_one_instrument = true;
  effect.confused_with = "shaft_torsion";
  effect.of_several_stretches = true;  // a fraction and a dead band
  return effect;
}

}  // namespace ostium::data
