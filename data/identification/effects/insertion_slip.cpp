/// Part of the commanded insertion is lost, as a fraction or a length: the rollers slip or the zero is off.
#include "core/base/units.h"
#include "data/identification/effects/tools.h"

namespace ostium::data {

namespace insertion_slip_parts {

using units::mm;
constexpr double least_m = 2e-3;

std::string why_not(const MeasurementSet&, std::optional<int>) { return ""; }

void apply(const ActiveEffect& effect, const MeasurementSet& set, const Experiment& e, ExperimentSetup& setup) {
  for (std::size_t i = 0; i < setup.nest.parts.size(); ++i) {
    if (!chosen(effect.instrument, i)) continue;
    const double left = e.set[i].inserted_m * (1 - effect.values[0]) - effect.values[1] * mm;
    setup.nest.parts[i].inserted_m = std::clamp(left, least_m, set.instruments[i].length_m);
  }
}

std::vector<EffectForm> forms(const MeasurementSet& set, std::optional<int> instrument) {
  bool varies = false;
  for (const Experiment& e : set.experiments)
    for (std::size_t i = 0; i < e.set.size(); ++i)
      varies = varies || (chosen(instrument, i) && e.set[i].inserted_m != set.experiments[0].set[i].inserted_m);
  if (!varies) return {{"", {{"offset_mm", 0}}}};
  return {{"fraction", {{"offset_mm", 0}}}, {"offset", {{"fraction", 0}}}};
}

}  // namespace insertion_slip_parts

Effect insertion_slip() {
  using namespace insertion_slip_parts;
  Effect effect;
  effect.id = "insertion_slip";
  effect.what = "loss of commanded insertion";
  effect.parameters = {
      {"fraction", "1", "part of the commanded insertion that does not arrive", 0, 0.05, -0.3, 0.6, false},
      {"offset_mm", "mm", "length of the commanded insertion that does not arrive", 0, 5, -60, 60, false}};
  effect.why_not = why_not, effect.apply = apply, effect.forms = forms;
  effect.of_one_instrument = true;
  effect.confused_with = "imaging_scale";
  return effect;
}

}  // namespace ostium::data
