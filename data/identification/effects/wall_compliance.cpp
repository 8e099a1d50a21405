/// A compliant wall: a force per length of instrument and depth, instead of a rigid one (core/wall). A silicone or
/// arterial wall of modulus E and thickness h around a lumen of radius R has a stiffness of the order of E h / R.
#include "core/base/units.h"
#include "data/identification/effects/effect.h"

namespace ostium::data {

namespace wall_compliance_parts {

using units::N_per_mm2;

std::string why_not(const MeasurementSet& set, std::optional<int>) { return set.vessel ? "" : "there is no vessel"; }

void apply(const ActiveEffect& effect, const MeasurementSet&, const Experiment&, ExperimentSetup& setup) {
  setup.wall_stiffness_N_m2 = effect.values[0] * N_per_mm2;
}

}  // namespace wall_compliance_parts

Effect wall_compliance() {
  using namespace wall_compliance_parts;
  Effect effect;
  effect.id = "wall_compliance";
  effect.what = "a wall that gives way";
  effect.parameters = {
      {"stiffness_N_per_mm2", "N/mm2", "force per length and depth of the wall", 0.05, 2, 1e-4, 100, true}};
  effect.why_not = why_not, effect.apply = apply;
  return effect;
}

}  // namespace ostium::data
