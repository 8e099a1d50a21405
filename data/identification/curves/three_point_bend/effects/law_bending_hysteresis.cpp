/// Bending with memory as the data show it: play elements of fixed thresholds r_j in series (Prandtl and Ishlinskii's
/// operator; Visintin 1994, Differential models of hysteresis, III.2),
///   kappa = m + sum over j of w_j play_j(m),   m = M / EI,   w_j = C_j - C_{j-1} >= 0,
/// where C_j = exp(sum over i <= j of e_i) is the compliance on first loading beyond r_j, and each e_i > 0 is
/// log-normal. On its way back a section follows the same curve at twice the scale (Masing's rule). A coil that slips
/// in many places, or a wire that yields little by little, bends so.
#include "data/identification/curves/three_point_bend/three_point_bend.h"
#include "data/identification/effects/bending_law.h"

namespace ostium::data::three_point_bend {

namespace {

constexpr double first = 0.03;  // threshold, in largest curvatures

Plays plays_of(const std::vector<double>& v) {
  Plays out;
  out.count = Plays::most;
  double log_compliance = 0, before = 1;
  for (int j = 0; j < Plays::most; ++j) {
    log_compliance = std::min(log_compliance + v[static_cast<std::size_t>(1 + j)], std::log(50.0));
    out.from_per_m[j] = v[0] / 1e-3 * first * std::pow(0.8 / first, j / (Plays::most - 1.0));
    out.weight[j] = std::exp(log_compliance) - before;
    before = std::exp(log_compliance);
  }
  return out;
}

/// Moment over EI at a curvature, on first loading.
double moment_per_m(const Plays& plays, double k) {
  double at = 0, moment = 0, compliance = 1;
  for (int j = 0; j < plays.count; ++j) {
    const double next = at + (plays.from_per_m[j] - moment) * compliance;
    if (k <= next) break;
    at = next, moment = plays.from_per_m[j], compliance += plays.weight[j];
  }
  return moment + (k - at) / compliance;
}

/// What slips between two thresholds all slips at the first here; slipping evenly it would move the curve by up to an
/// eighth of what it gives over the interval.
double too_fine(const Plays& plays, double k) {
  const double moment = moment_per_m(plays, k);
  double most = 0;
  for (int j = 0; j + 1 < plays.count && plays.from_per_m[j] < moment; ++j)
    most = plays.weight[j] * (plays.from_per_m[j + 1] - plays.from_per_m[j]) / 8;
  return most / k;
}

}  // namespace

Effect law_bending_hysteresis() {
  Effect effect;
  effect.head.id = "law:bending_hysteresis";
  effect.head.what = "bending with memory as the data show it";
  effect.head.parameters = {{"reach_per_mm", "1/mm", "largest curvature of the law", 0.05, 0, 1e-5, 10, false}};
  for (int j = 1; j <= Plays::most; ++j)
    effect.head.parameters.push_back({"gives_" + std::to_string(j), "1",
                                      "of ln(compliance), what slips beyond a threshold", 0.03, 1.5, 1e-4, 4, true});
  effect.apply = [](const std::vector<double>& v, Setup& setup) { setup.section.plays = plays_of(v); };
  effect.adapt = [](const Setup& declared, std::vector<EffectParameter>& p) {
    p[0].prior = largest_curvature_per_m(declared) * 1e-3;
  };
  effect.head.law = [](const std::vector<double>& v, std::span<const double> free) {
    const Plays plays = plays_of(v);
    return bending_law::table(
        "law:bending_hysteresis", free[0], v[0] / 1e-3, [&](double k) { return moment_per_m(plays, k); },
        [&](double k) { return too_fine(plays, k); });
  };
  return effect;
}

}  // namespace ostium::data::three_point_bend
