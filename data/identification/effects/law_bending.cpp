/// The moment-curvature curve as the data show it (bending_law.h): whatever form it has, as long as it rises; the same
/// there and back, and at the same curvature everywhere. Law: core/material/tabulated.h. For a single instrument.
#include <cmath>

#include "core/base/units.h"
#include "data/identification/effects/bending_law.h"
#include "data/identification/effects/tools.h"

namespace ostium::data {

namespace law_bending_parts {

using units::mm;

core::BendingCurve curve_of(const ActiveEffect& effect) {
  return bending_law::curve_of(std::span(effect.values).subspan(1), effect.values[0] / mm);
}

std::string why_not(const MeasurementSet& set, std::optional<int> instrument) {
  for (const DeclaredEffect& d : set.effects)
    if (d.id == "superelastic_softening") return "the set declares how bending softens";
  return why_not_learned(set, instrument);
}

void apply(const ActiveEffect& effect, const MeasurementSet&, const Experiment&, ExperimentSetup& setup) {
  const core::BendingCurve curve = curve_of(effect);
  for (core::Section& s : setup.nest.parts[0].sections) s.bending = curve, s.softened_ratio = 1;
}

LawCurve law(const ActiveEffect& effect, const MeasurementSet&, const Changes& changes) {
  const core::BendingCurve curve = curve_of(effect);
  const double scale = changes.stiffness_scale.empty() ? 1 : changes.stiffness_scale[0].back();
  return bending_law::table(
      "law:bending", scale, effect.values[0] / mm, [&](double k) { return curve.moment_per_m(k); },
      [](double) { return bending_law::too_fine(); });
}

/// The largest curvature that loads and weight can cause in any experiment, as far as a quarter turn over what is
/// inserted lets them.
double reach_per_m(const MeasurementSet& set) {
  double out = 0;
  for (const Experiment& e : set.experiments) {
    const double inserted = e.set[0].inserted_m;
    double weight = 0;  // of what is distal, N
    for (const core::Section& s : set.instruments[0].sections) {
      const double end = std::min(s.to_tip_m, inserted);
      if (end <= s.from_tip_m) break;
      weight += (end - s.from_tip_m) * s.kg_per_m * set.gravity_m_s2.norm();
      const double moment = end * (e.tip_force_N.norm() + weight / 2);
      out = std::max(out, std::min(moment / s.EI1_N_m2, units::pi / end));
    }
  }
  return out;
}

std::vector<EffectForm> forms(const MeasurementSet& set, std::optional<int>) {
  return {{"", {{"reach_per_mm", std::clamp(reach_per_m(set) * mm, 1e-5, 10.0)}}}};
}

}  // namespace law_bending_parts

Effect law_bending() {
  using namespace law_bending_parts;
  Effect effect;
  effect.id = "law:bending";
  effect.what = "bending as the data show it";
  effect.parameters = {{"reach_per_mm", "1/mm", "largest curvature of the law", 0.05, 1, 1e-5, 10, false}};
  for (int j = 1; j <= bending_law::knots; ++j)
    effect.parameters.push_back({"step_" + std::to_string(j), "1", "of ln(tangent stiffness), from knot to knot", 0,
                                 bending_law::step_spread, -bending_law::most_step, bending_law::most_step, false});
  effect.why_not = why_not, effect.apply = apply, effect.forms = forms, effect.law = law;
  effect.in_instrument = true;
  return effect;
}

}  // namespace ostium::data
