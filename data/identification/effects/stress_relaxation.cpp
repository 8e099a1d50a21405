/// Stress relaxation of a heat-set (curved at rest) instrument with the time t in position, with two branches
/// (generalised Maxwell solid): 1 - f1 (1 - exp(-t / t1)) - f2 (1 - exp(-t / t2)). If nested instruments hold it away
/// from its rest shape, its modulus relaxes; alone, its rest curvature does.
#include <cmath>

#include "data/identification/effects/effect.h"

namespace ostium::data {

namespace stress_relaxation_parts {

bool curved(const std::vector<core::Section>& sections) {
  for (const core::Section& s : sections)
    if (!s.rest_curvature_per_m.isZero()) return true;
  return false;
}

std::string why_not(const MeasurementSet& set, std::optional<int> instrument) {
  if (set.vessel) return "in a vessel nothing relaxes yet";
  bool timed = false, heat_set = false;
  for (const Experiment& e : set.experiments) timed = timed || e.elapsed_s.value_or(0) > 0;
  for (std::size_t i = 0; i < set.instruments.size(); ++i)
    if (!instrument || *instrument == static_cast<int>(i)) heat_set = heat_set || curved(set.instruments[i].sections);
  if (!timed) return "no experiment gives elapsed_s";
  if (!heat_set) return "no instrument that could relax is curved at rest";
  return "";
}

void apply(const ActiveEffect& effect, const MeasurementSet&, const Experiment& e, ExperimentSetup& setup) {
  const auto& v = effect.values;
  const double t = e.elapsed_s.value_or(0);
  const double left = 1 - v[0] * -std::expm1(-t / v[1]) - v[2] * -std::expm1(-t / v[3]);
  for (std::size_t i = 0; i < setup.nest.parts.size(); ++i) {
    auto& sections = setup.nest.parts[i].sections;
    if ((effect.instrument && *effect.instrument != static_cast<int>(i)) || !curved(sections)) continue;
    for (core::Section& s : sections) {
      if (v[4] == 0 || (v[4] < 0 && setup.nest.parts.size() == 1))
        s.rest_curvature_per_m *= left;
      else
        s.EI1_N_m2 *= left, s.EI2_N_m2 *= left, s.GJ_N_m2 *= left;
    }
  }
}

/// One branch or two, acting on the quantity above or on the other one.
std::vector<EffectForm> forms(const MeasurementSet& set, std::optional<int>) {
  const double usual = set.instruments.size() > 1 ? 1 : 0;
  std::vector<EffectForm> out;
  for (double of : {usual, 1 - usual}) {
    const std::string words = of == 1 ? "modulus" : "rest curvature";
    out.push_back({words, {{"of_modulus", of}}});
    out.push_back({words + ", one branch", {{"of_modulus", of}, {"fraction_2", 0}, {"time_2_s", 900}}});
  }
  return out;
}

}  // namespace stress_relaxation_parts

Effect stress_relaxation() {
  using namespace stress_relaxation_parts;
  Effect effect;
  effect.id = "stress_relaxation";
  effect.what = "relaxation of the heat-set instrument";
  effect.parameters = {
      {"fraction_1", "1", "part that the fast branch loses", 0.1, 0.1, 0, 0.45, false},
      {"time_1_s", "s", "time constant of the fast branch", 60, 0.7, 5, 3000, true},
      {"fraction_2", "1", "part that the slow branch loses", 0.1, 0.1, 0, 0.45, false},
      {"time_2_s", "s", "time constant of the slow branch", 900, 0.7, 300, 20000, true},
      {"of_modulus", "1", "1: the modulus relaxes, 0: the curvature at rest, -1: the one if nested, the other if alone",
       -1, 1, -1, 1, false}};
  effect.why_not = why_not, effect.apply = apply, effect.forms = forms;
  effect.of_one_instrument = true;
  effect.in_instrument = true;
  return effect;
}

}  // namespace ostium::data
