/// Torsional stiffness that does not go with bending stiffness as declared: a coil that turns easily, a braid that does
/// not. GJ is multiplied by `factor`, EI stays. Law: the rod's own. For an instrument alone: of nested ones the shafts'
/// twist tells more (shaft_torsion).
#include "data/identification/effects/tools.h"

namespace ostium::data {

namespace torsion_ratio_parts {

std::string why_not(const MeasurementSet& set, std::optional<int>) {
  return set.instruments.size() > 1 ? "nested instruments twist along their shafts: shaft_torsion" : "";
}

void apply(const ActiveEffect& effect, const MeasurementSet&, const Experiment&, ExperimentSetup& setup) {
  for (core::Section& s : setup.nest.parts[0].sections) s.GJ_N_m2 *= effect.values[0];
}

}  // namespace torsion_ratio_parts

Effect torsion_ratio() {
  using namespace torsion_ratio_parts;
  Effect effect;
  effect.id = "torsion_ratio";
  effect.what = "torsional stiffness of another ratio to bending stiffness";
  effect.parameters = {{"factor", "1", "GJ against what is declared, EI as it is", 1, 0.7, 0.02, 20, true}};
  effect.why_not = why_not, effect.apply = apply;
  effect.in_instrument = true;
  return effect;
}

}  // namespace ostium::data
