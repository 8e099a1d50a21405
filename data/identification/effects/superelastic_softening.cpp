/// Bending that softens beyond a curvature, as in superelastic nitinol; the law is in core/material/superelastic.h.
/// With `of_moment` 1 each section softens beyond the moment that bends the shaft to that curvature, as where one wire
/// was drawn or ground to several stiffnesses; with 0 beyond the same curvature. For a single instrument.
#include <cmath>

#include "core/base/units.h"
#include "data/identification/effects/tools.h"

namespace ostium::data {

namespace superelastic_softening_parts {

using units::mm;

std::string why_not(const MeasurementSet& set, std::optional<int>) {
  return set.instruments.size() > 1 ? "nested instruments are modelled as linear" : "";
}

void apply(const ActiveEffect& effect, const MeasurementSet&, const Experiment&, ExperimentSetup& setup) {
  std::vector<core::Section>& sections = setup.nest.parts[0].sections;
  const double shaft_N_m2 = sections.back().EI1_N_m2;
  for (core::Section& s : sections) {
    const double stiffer = effect.values[2] > 0 ? s.EI1_N_m2 / shaft_N_m2 : 1;
    s.softening_per_m = effect.values[0] / mm / stiffer, s.softened_ratio = effect.values[1];
  }
}

std::vector<EffectForm> forms(const MeasurementSet& set, std::optional<int>) {
  std::vector<EffectForm> out = {{"at a curvature", {{"of_moment", 0}}}};
  if (set.instruments[0].sections.size() > 1) out.push_back({"at a moment", {{"of_moment", 1}}});
  return out;
}

/// Austenite begins to transform at a strain of about 1 %.
void adapt(const MeasurementSet& set, std::optional<int>, std::vector<EffectParameter>& p) {
  p[0].prior = std::min(0.01 / (set.instruments[0].radius_m / mm), p[0].most);
}

}  // namespace superelastic_softening_parts

Effect superelastic_softening() {
  using namespace superelastic_softening_parts;
  Effect effect;
  effect.id = "superelastic_softening";
  effect.what = "bending that softens beyond a curvature";
  effect.parameters = {
      {"curvature_per_mm", "1/mm", "curvature beyond rest at which bending softens", 0.05, 1.2, 1e-4, 1, true},
      {"ratio", "1", "stiffness far beyond it against that below", 0.3, 0.7, 0.02, 0.95, true},
      {"of_moment", "1", "1: at the moment that bends the last section so; 0: everywhere at the curvature", 0, 1, 0, 1,
       false}};
  effect.why_not = why_not, effect.apply = apply, effect.adapt = adapt, effect.forms = forms;
  effect.in_instrument = true;
  return effect;
}

}  // namespace ostium::data
