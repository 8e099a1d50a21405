/// Friction between wall and instruments that differs from the declared one: Coulomb's law (core/contact), static and
/// kinetic alike.
#include "data/identification/effects/effect.h"

namespace ostium::data {

namespace wall_friction_parts {

std::string why_not(const MeasurementSet& set, std::optional<int>) { return set.vessel ? "" : "there is no vessel"; }

void apply(const ActiveEffect& effect, const MeasurementSet&, const Experiment&, ExperimentSetup& setup) {
  setup.wall_friction = effect.values[0];
}

/// Centres the prior on the declared friction.
void adapt(const MeasurementSet& set, std::optional<int>, std::vector<EffectParameter>& p) {
  if (set.vessel && set.vessel->friction > 0.005) p[0].prior = set.vessel->friction;
}

}  // namespace wall_friction_parts

Effect wall_friction() {
  using namespace wall_friction_parts;
  Effect effect;
  effect.id = "wall_friction";
  effect.what = "another friction of the wall";
  effect.parameters = {{"coefficient", "1", "friction of wall and instruments", 0.05, 1, 0.002, 1.5, true}};
  effect.why_not = why_not, effect.apply = apply, effect.adapt = adapt;
  return effect;
}

}  // namespace ostium::data
