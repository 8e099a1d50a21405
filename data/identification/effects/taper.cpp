/// A taper that is declared as a step: between `from_tip_mm` and `length_mm` behind it stiffness goes linearly from
/// what it is before to what it is behind, as of a core ground to a cone (for short tapers a line is as good as the
/// fourth power of its diameter). Law: the rod's own, in ten pieces.
#include <cmath>

#include "core/base/units.h"
#include "data/identification/effects/tools.h"

namespace ostium::data {

namespace taper_parts {

using units::mm;

constexpr int pieces = 10;

std::string why_not(const MeasurementSet& set, std::optional<int> instrument) {
  if (!instrument && set.instruments.size() > 1) return "each instrument has its own steps";
  const auto& sections = set.instruments[instrument.value_or(0)].sections;
  for (std::size_t s = 0; s + 1 < sections.size(); ++s)
    if (sections[s].EI1_N_m2 != sections[s + 1].EI1_N_m2 && sections[s].to_tip_m < longest_inserted(set, instrument))
      return "";
  return "no step of stiffness is declared on what is inserted";
}

const core::Section& at(const std::vector<core::Section>& sections, double from_tip_m) {
  for (const core::Section& s : sections)
    if (from_tip_m < s.to_tip_m) return s;
  return sections.back();
}

void apply(const ActiveEffect& effect, const MeasurementSet&, const Experiment&, ExperimentSetup& setup) {
  std::vector<core::Section>& sections = setup.nest.parts[effect.instrument.value_or(0)].sections;
  const double from = effect.values[0] * mm, length = effect.values[1] * mm;
  const core::Section before = at(sections, std::max(from - 1e-6, 0.0)), behind = at(sections, from + length);
  for (int k = 0; k < pieces; ++k) {
    const double t = (k + 0.5) / pieces;
    const auto between = [t](double a, double b) { return (1 - t) * a + t * b; };
    change_stretch(sections, from + length * k / pieces, from + length * (k + 1) / pieces, [&](core::Section& s) {
      s.EI1_N_m2 = between(before.EI1_N_m2, behind.EI1_N_m2), s.EI2_N_m2 = between(before.EI2_N_m2, behind.EI2_N_m2);
      s.GJ_N_m2 = between(before.GJ_N_m2, behind.GJ_N_m2);
    });
  }
}

/// Near the first step that is declared.
void adapt(const MeasurementSet& set, std::optional<int> instrument, std::vector<EffectParameter>& p) {
  const auto& sections = set.instruments[instrument.value_or(0)].sections;
  p[0].prior = sections.size() > 1 ? sections[0].to_tip_m / mm : p[0].prior;
  p[0].most = p[1].most = longest_inserted(set, instrument) / mm;
}

}  // namespace taper_parts

Effect taper() {
  using namespace taper_parts;
  Effect effect;
  effect.id = "taper";
  effect.what = "a taper where a step is declared";
  effect.parameters = {{"from_tip_mm", "mm", "where the taper begins, from the tip", 50, 20, 0, 5000, false},
                       {"length_mm", "mm", "length of the taper", 40, 0.6, 2, 5000, true}};
  effect.why_not = why_not, effect.apply = apply, effect.adapt = adapt;
  effect.of_one_instrument = true;
  effect.in_instrument = true;
  return effect;
}

}  // namespace ostium::data
