/// Stiffness along the instrument as the data show it: ln(EI / declared) as a function of the distance s from the tip,
///   sum over k of c_k cos(pi k s / reach),   c_k normal, of standard deviation 0.45 / (1 + (pi k l / reach)^2 / 3),
/// the cosine expansion of a field whose spectrum is Matern's of order 3/2 (Rasmussen, Williams 2006, Gaussian
/// processes for machine learning, 4.2.1; Solin, Sarkka 2020, Stat Comput 30:419), with the correlation length l an
/// eighth of the reach: by some 60 %, smooth over an eighth of what is inserted. GJ goes with EI. Behind the reach it
/// stays as it is there. Law: the rod's own, in 48 pieces.
#include <cmath>

#include "core/base/units.h"
#include "data/identification/effects/tools.h"

namespace ostium::data {

namespace law_stiffness_parts {

using units::mm, units::pi;

constexpr int modes = 14, pieces = 48, table_points = 61;
constexpr double size = 0.45, correlation = 0.125;  // correlation length in reaches

double log_stiffness(const std::vector<double>& values, double from_tip_m) {
  const double t = std::clamp(from_tip_m / (values[0] * mm), 0.0, 1.0);
  double sum = 0;
  for (int k = 1; k <= modes; ++k) sum += values[k] * std::cos(pi * k * t);
  return sum;
}

void apply(const ActiveEffect& effect, const MeasurementSet&, const Experiment&, ExperimentSetup& setup) {
  std::vector<core::Section>& sections = setup.nest.parts[0].sections;
  const double reach = effect.values[0] * mm;
  const auto scale = [&](double from, double to, double at) {
    const double factor = std::exp(log_stiffness(effect.values, at));
    change_stretch(sections, from, to,
                   [&](core::Section& s) { s.EI1_N_m2 *= factor, s.EI2_N_m2 *= factor, s.GJ_N_m2 *= factor; });
  };
  for (int k = 0; k < pieces; ++k) scale(reach * k / pieces, reach * (k + 1) / pieces, reach * (k + 0.5) / pieces);
  scale(reach, sections.back().to_tip_m, reach);
}

/// Standard deviation of the prior of a wave of k half periods.
double spread_of(int k) {
  const double wave = pi * k * correlation;
  return size / (1 + wave * wave / 3);
}

/// Standard deviation of the waves that the law leaves out, in the mean over the reach.
double too_fine() {
  constexpr int endless = 500;
  double variance = 0;
  for (int k = modes + 1; k < endless; ++k) variance += spread_of(k) * spread_of(k) / 2;
  return std::sqrt(variance);
}

LawCurve law(const ActiveEffect& effect, const MeasurementSet& set, const Changes& changes) {
  LawCurve out{"law:stiffness", "distance from the tip", "mm", "EI against what is declared", "1", {}, 1};
  out.too_fine.assign(table_points, too_fine());
  const auto& sections = set.instruments[0].sections;
  for (int i = 0; i < table_points; ++i) {
    const double s_mm = effect.values[0] * i / (table_points - 1);
    std::size_t in = 0;
    while (in + 1 < sections.size() && sections[in].to_tip_m <= s_mm * mm) ++in;
    const double scale = changes.stiffness_scale.empty() ? 1 : changes.stiffness_scale[0][in];
    out.points.emplace_back(s_mm, scale * std::exp(log_stiffness(effect.values, s_mm * mm)));
  }
  return out;
}

std::vector<EffectForm> forms(const MeasurementSet& set, std::optional<int> instrument) {
  return {{"", {{"reach_mm", longest_inserted(set, instrument) / mm}}}};
}

}  // namespace law_stiffness_parts

Effect law_stiffness() {
  using namespace law_stiffness_parts;
  Effect effect;
  effect.id = "law:stiffness";
  effect.what = "stiffness along the instrument as the data show it";
  effect.parameters = {{"reach_mm", "mm", "how far from the tip the law goes", 300, 1, 1, 5000, false}};
  for (int k = 1; k <= modes; ++k)
    effect.parameters.push_back({"c_" + std::to_string(k), "1",
                                 "of ln(EI / declared), the wave of " + std::to_string(k) + " half periods", 0,
                                 spread_of(k), -4, 4, false});
  effect.why_not = why_not_learned, effect.apply = apply, effect.forms = forms, effect.law = law;
  effect.in_instrument = true;
  return effect;
}

}  // namespace ostium::data
