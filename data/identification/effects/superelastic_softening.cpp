/// Bending that softens beyond a curvature, as in superelastic nitinol; the law is in core/material/superelastic.h. For
/// a single instrument.
#include <cmath>

#include "core/base/units.h"
#include "data/identification/effects/tools.h"

namespace ostium::data {

namespace {

using units::mm;

std::string why_not(const MeasurementSet& set, std::optional<int>) {
  return set.instruments.size() > 1 ? "nested instruments are modelled as linear" : "";
}

void apply(const ActiveEffect& effect, const MeasurementSet&, const Experiment&, ExperimentSetup& setup) {
  for (core::Section& s : setup.nest.parts[0].sections)
    s.softening_per_m = effect.values[0] / mm, s.softened_ratio = effect.values[1];
}

/// Austenite begins to transform at a strain of about 1 %.
void adapt(const MeasurementSet& set, std::optional<int>, std::vector<EffectParameter>& p) {
  p[0].prior = std::min(0.01 / (set.instruments[0].radius_m / mm), p[0].most);
}

}  // namespace

Effect superelastic_softening() {
  Effect effect;
  effect.id = "superelastic_softening";
  effect.what = "bending that softens beyond a curvature";
  effect.parameters = {
      {"curvature_per_mm", "1/mm", "curvature beyond rest at which bending softens", 0.05, 1.2, 1e-4, 1, true},
      {"ratio", "1", "stiffness far beyond it against that below", 0.3, 0.7, 0.02, 0.95, true}};
  effect.why_not = why_not, effect.apply = apply, effect.adapt = adapt;
  effect.in_instrument = true;
  return effect;
}

}  // namespace ostium::data
