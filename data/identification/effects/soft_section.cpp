/// An undeclared stretch of different stiffness: a solder joint, a kink, a braid that ends. EI and GJ are multiplied by
/// `factor` from `from_tip_mm` on, over `length_mm`. Law: the rod's own.
#include <cmath>

#include "core/base/units.h"
#include "data/identification/effects/tools.h"

namespace ostium::data {

namespace soft_section_parts {

using units::mm;

std::string why_not(const MeasurementSet&, std::optional<int>) { return ""; }

void apply(const ActiveEffect& effect, const MeasurementSet&, const Experiment&, ExperimentSetup& setup) {
  const auto& v = effect.values;
  for (std::size_t i = 0; i < setup.nest.parts.size(); ++i)
    if (chosen(effect.instrument, i))
      change_stretch(setup.nest.parts[i].sections, v[0] * mm, (v[0] + v[1]) * mm,
                     [&](core::Section& s) { s.EI1_N_m2 *= v[2], s.EI2_N_m2 *= v[2], s.GJ_N_m2 *= v[2]; });
}

void adapt(const MeasurementSet& set, std::optional<int> instrument, std::vector<EffectParameter>& p) {
  const double longest = longest_inserted(set, instrument) / mm;
  p[0].prior = longest / 2, p[0].spread = longest / 3, p[0].most = longest;
  p[1].prior = longest / 8, p[1].most = longest / 2;
  p[1].least = longest / 100;
}

/// Two of them are two forms of the same; the second is tried where the first is.
std::vector<EffectForm> forms(const MeasurementSet&, std::optional<int>) { return {{"", {}}, {another_form, {}}}; }

}  // namespace soft_section_parts

Effect soft_section() {
  using namespace soft_section_parts;
  Effect effect;
  effect.id = "soft_section";
  effect.what = "a stretch of other stiffness";
  effect.parameters = {{"from_tip_mm", "mm", "where the other stiffness begins, from the tip", 100, 60, 0, 5000, false},
                       {"length_mm", "mm", "length of the stretch", 20, 0.6, 0.5, 5000, true},
                       {"factor", "1", "its stiffness against what is declared there", 1, 0.9, 0.02, 50, true}};
  effect.why_not = why_not, effect.apply = apply, effect.adapt = adapt, effect.forms = forms;
  effect.of_several_stretches = true;
  effect.of_one_instrument = true;
  effect.in_instrument = true;
  return effect;
}

}  // namespace ostium::data
