#include "data/identification/curves/push_pull/saw_teeth.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace ostium::data::push_pull {

namespace {

using Eigen::ArrayXd;
using Eigen::VectorXd;

constexpr double cell = 1.0 / 32, top = 1.5;  // of what builds up until it slips on the mean
constexpr int cells = 48;
constexpr double wander = 0.1;       // estimate: scatter of that from slip to slip
constexpr double unforeseen = 1e-3;  // chance that a sample is a blunder, from which nothing is learned
constexpr double least_N = 1e-9;
constexpr double longest_step = 0.5, far = 4;  // in teeth: of one step of the filter; after which it is anywhere
static_assert(cells * cell == top);

double place(int i) { return (i + 0.5) * cell; }

/// The chance that it stands until `u`: friction at rest is normal from slip to slip. From a table, as it is asked for
/// thousands of times a run.
double stands_until(double u) {
  static constexpr double first = 0.5, step = 1.0 / 512;
  static constexpr int count = 513;
  static const ArrayXd table = [] {
    ArrayXd out(count);
    for (int i = 0; i < count; ++i)
      out[i] = std::max(0.5 * std::erfc((first + i * step - 1) / wander / std::sqrt(2.0)), 1e-12);
    return out;
  }();
  const double at = (u - first) / step;
  if (at <= 0) return 1;
  if (at >= count - 1) return table[count - 1];
  const int below = static_cast<int>(at);
  return table[below] + (at - below) * (table[below + 1] - table[below]);
}

/// Of what has built up when nothing is known but that it sticks and slips (the age of a renewal process).
ArrayXd anywhere() {
  ArrayXd out(cells);
  for (int i = 0; i < cells; ++i) out[i] = stands_until(place(i));
  return out / out.sum();
}

/// What has built up is `kept` of what it was, as a share of the most, and grows by `by`, at most `longest_step`, or
/// slips on the way.
ArrayXd grown(const ArrayXd& chance, double kept, double by) {
  ArrayXd out = ArrayXd::Zero(cells);
  double slipped = 0;
  for (int i = 0; i < cells; ++i) {
    const double from = std::min(place(i) * kept, top), to = from + by;
    const double stands = chance[i] * std::min(stands_until(to) / stands_until(from), 1.0);
    slipped += chance[i] - stands;
    const double at = std::clamp(to / cell - 0.5, 0.0, cells - 1.0);
    const int below = std::min(static_cast<int>(at), cells - 2);
    out[below] += stands * (below + 1 - at), out[below + 1] += stands * (at - below);
  }
  // Where in the step it slipped is not known: what has built up since is anything up to the whole step.
  const double reach = std::max(by / cell, 1.0);
  for (int i = 0; i < reach; ++i) out[i] += slipped * std::min(reach - i, 1.0) / reach;
  return out;
}

}  // namespace

SawTeeth saw_teeth(const SlidingRun& run, const Sticking& sticking) {
  static const ArrayXd unknown = anywhere();
  const Eigen::Index n = run.inserted_m.size();
  SawTeeth out{VectorXd::Zero(n), VectorXd::Zero(n)};
  ArrayXd place_of(cells), chance = unknown;
  for (int i = 0; i < cells; ++i) place_of[i] = place(i);
  double most_before = 0;
  for (Eigen::Index k = 0; k < n; ++k) {
    const double most = sticking.static_more * std::max(run.friction_N[k], least_N);
    const double moved_m = k > 0 ? std::fabs(run.inserted_m[k] - run.inserted_m[k - 1]) : 0;
    const double by = sticking.stiffness_N_per_m * moved_m / most;
    if (k == 0 || run.direction[k] != run.direction[k - 1] || by > far) {
      chance = unknown;
    } else {
      const int steps = std::max(static_cast<int>(std::ceil(by / longest_step)), 1);
      for (int i = 0; i < steps; ++i) chance = grown(chance, i == 0 ? most_before / most : 1, by / steps);
    }
    most_before = most;
    const ArrayXd built = most * place_of;
    const double mean = (chance * built).sum();
    const double variance = (chance * (built - mean).square()).sum() + std::pow(most * cell, 2) / 12;
    out.mean_N[k] = run.direction[k] * mean, out.spread_N[k] = std::sqrt(variance);
    const ArrayXd off = (run.direction[k] * (run.measured_N[k] - run.moving_N[k]) - built) / run.sigma_N[k];
    chance *= (-0.5 * off.square()).exp() + unforeseen;
    chance /= chance.sum();
  }
  return out;
}

double surprise(const SlidingRun& run, const SawTeeth& teeth) {
  const ArrayXd wider = (1 + (teeth.spread_N.array() / run.sigma_N.array()).square()).sqrt();
  const ArrayXd off = (run.measured_N - run.moving_N - teeth.mean_N).array() / run.sigma_N.array() / wider;
  return off.square().sum() + 2 * wider.log().sum();
}

namespace {

/// The mean of neighbours, a sixteenth of the run to either side.
VectorXd slow_part(const VectorXd& x) {
  const Eigen::Index n = x.size(), reach = std::max<Eigen::Index>(n / 16, 2);
  VectorXd out(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const Eigen::Index from = std::max<Eigen::Index>(k - reach, 0), to = std::min(k + reach, n - 1);
    out[k] = x.segment(from, to - from + 1).mean();
  }
  return out;
}

}  // namespace

Sticking likely_sticking(SlidingRun run) {
  const Eigen::Index n = run.inserted_m.size();
  const double apart = (run.inserted_m.tail(n - 1) - run.inserted_m.head(n - 1)).cwiseAbs().mean();
  const double friction = run.friction_N.mean();
  Sticking best;
  if (!(apart > 0) || !(friction > least_N)) return best;
  const VectorXd slow = run.moving_N + slow_part(run.measured_N - run.moving_N);
  double least = std::numeric_limits<double>::infinity();
  for (double more = 0.03; more < 4; more *= 2)
    for (double samples = 1.5; samples < static_cast<double>(n) / 8; samples *= 1.15) {  // a tooth
      const Sticking s{more, more * friction / (samples * apart)};
      run.moving_N = slow - 0.5 * more * run.friction_N.cwiseProduct(run.direction);
      const double now = surprise(run, saw_teeth(run, s));
      if (now < least) least = now, best = s;
    }
  return best;
}

}  // namespace ostium::data::push_pull
