/// An undeclared weight on the instrument: a marker, a torquer, a drop of glue. A dead load m g at a point of its
/// centreline.
#include <cmath>

#include "core/base/units.h"
#include "data/identification/effects/tools.h"

namespace ostium::data {

namespace lumped_mass_parts {

using units::mm, units::gram;

std::string why_not(const MeasurementSet& set, std::optional<int>) {
  if (set.vessel) return "in a vessel no weight is hung on it";
  return set.gravity_m_s2.isZero() ? "there is no gravity" : "";
}

void apply(const ActiveEffect& effect, const MeasurementSet& set, const Experiment&, ExperimentSetup& setup) {
  const std::size_t on = effect.instrument.value_or(static_cast<int>(setup.nest.parts.size()) - 1);
  const double from_base = setup.nest.parts[on].inserted_m - effect.values[1] * mm;
  if (from_base > 0) setup.nest.loads.push_back({from_base, effect.values[0] * gram * set.gravity_m_s2});
}

void adapt(const MeasurementSet& set, std::optional<int> instrument, std::vector<EffectParameter>& p) {
  const std::size_t on = instrument.value_or(static_cast<int>(set.instruments.size()) - 1);
  const double longest = longest_inserted(set, static_cast<int>(on));
  const double weight = integrate(set.instruments[on].sections, 0, longest).mass;
  p[0].spread = std::max(0.5 * weight / gram, 1e-3), p[0].most = 40 * p[0].spread;
  p[1].prior = longest / 2 / mm, p[1].spread = longest / 3 / mm, p[1].most = longest / mm;
}

}  // namespace lumped_mass_parts

Effect lumped_mass() {
  using namespace lumped_mass_parts;
  Effect effect;
  effect.id = "lumped_mass";
  effect.what = "a weight that hangs on the instrument";
  effect.parameters = {{"mass_g", "g", "of the weight", 0, 0.1, 0, 100, false},
                       {"from_tip_mm", "mm", "where it hangs, from the tip", 100, 60, 0, 5000, false}};
  effect.why_not = why_not, effect.apply = apply, effect.adapt = adapt;
  effect.in_instrument = true;
  effect.confused_with = "self_weight";
  return effect;
}

}  // namespace ostium::data
