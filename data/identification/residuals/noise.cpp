#include "data/identification/residuals/noise.h"

#include <Eigen/Core>
#include <cmath>

#include "core/math/dense.h"
#include "data/identification/forward/misfit.h"
#include "data/identification/measurement/measured_curves.h"

namespace ostium::data {

namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

struct Mean {
  double sum = 0, count = 0;
};

/// Unit weights on n points at `t` that cancel every polynomial of degree n - 2.
VectorXd annihilator(const VectorXd& t) {
  const Eigen::Index n = t.size();
  Eigen::MatrixXd powers(n, n - 1);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index d = 0; d < n - 1; ++d) powers(i, d) = std::pow((t[i] - t.mean()) / (t[n - 1] - t[0]), d);
  return core::perpendicular_to_columns(powers);
}

/// Misfits are perpendicular to the wire: how many of a point's three numbers are free.
double free_numbers(const Experiment& e) {
  return static_cast<double>(numbers_measured(e)) / static_cast<double>(distances(e));
}

/// Adds the squared part that a cubic cannot follow, per coordinate, over all windows of five points.
void add_point_to_point(const MeasuredCurve& curve, double numbers, const VectorXd& off, Mean& mean) {
  const Eigen::Index count = static_cast<Eigen::Index>(curve.from_tip_m.size()),
                     window = std::min<Eigen::Index>(5, count);
  if (window < 3) return;
  VectorXd s = VectorXd::Zero(count);
  for (Eigen::Index i = 1; i < count; ++i)
    s[i] = s[i - 1] + std::max(curve.from_tip_m[i - 1] - curve.from_tip_m[i], 1e-9);
  const auto first = static_cast<Eigen::Index>(curve.first);
  for (Eigen::Index i = 0; i + window <= count; ++i) {
    const VectorXd w = annihilator(s.segment(i, window));
    Vector3d left = Vector3d::Zero();
    for (Eigen::Index k = 0; k < window; ++k) left += w[k] * off.segment<3>(3 * (first + i + k));
    mean.sum += left.squaredNorm(), mean.count += numbers;
  }
}

bool alike(const Experiment& a, const Experiment& b) {
  if (a.kind != b.kind || a.base.p_W != b.base.p_W || a.base.q_W != b.base.q_W || a.tip_force_N != b.tip_force_N ||
      a.elapsed_s != b.elapsed_s || a.specimen != b.specimen)
    return false;
  for (std::size_t i = 0; i < a.set.size(); ++i)
    if (a.set[i].inserted_m != b.set[i].inserted_m || a.set[i].roll_rad != b.set[i].roll_rad ||
        a.set[i].shaft_m != b.set[i].shaft_m)
      return false;
  return true;
}

VectorXd measured(const Experiment& e) {
  return e.kind == Experiment::Kind::radius ? VectorXd(VectorXd::Constant(1, e.radius_m)) : VectorXd(e.points_m[0]);
}

Mean over_repeats(const MeasurementSet& set) {
  Mean mean;
  std::vector<bool> seen(set.experiments.size(), false);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const Experiment& e = set.experiments[i];
    if (seen[i] || !measured_curves(e).empty()) continue;
    VectorXd sum = measured(e);
    double squares = sum.squaredNorm(), n = 1;
    for (std::size_t j = i + 1; j < seen.size(); ++j)
      if (alike(e, set.experiments[j])) {
        seen[j] = true;
        const VectorXd other = measured(set.experiments[j]);
        sum += other, squares += other.squaredNorm(), n += 1;
      }
    mean.sum += squares - sum.squaredNorm() / n;
    mean.count += (n - 1) * static_cast<double>(sum.size());
  }
  return mean;
}

}  // namespace

VectorXd along(const Experiment& e) {
  const auto count = static_cast<Eigen::Index>(e.points_m.size());
  VectorXd s = VectorXd::Zero(count);
  for (Eigen::Index i = 1; i < count; ++i) s[i] = s[i - 1] + std::max((e.points_m[i] - e.points_m[i - 1]).norm(), 1e-9);
  return s;
}

bool has_traces(const MeasurementSet& set) {
  if (set.vessel) return false;
  for (const Experiment& e : set.experiments)
    if (e.kind != Experiment::Kind::centreline) return false;
  return true;
}

std::vector<ResidualTrace> traces_of(const MeasurementSet& set, const std::vector<VectorXd>& misfits) {
  std::vector<ResidualTrace> out;
  for (std::size_t i = 0; i < set.experiments.size(); ++i)
    out.push_back({along(set.experiments[i]), misfits[i].reshaped(3, misfits[i].size() / 3).transpose(), 2});
  return out;
}

std::optional<NoiseModel> other_noise(const MeasurementSet& set, const std::vector<VectorXd>& misfits) {
  if (!has_traces(set)) return {};
  const NoiseModel m = noise_model_of(traces_of(set, misfits), set.imaging.noise_sigma_m);
  if (m.as_declared || (!set.imaging.noise_sigma_m && !m.correlated() && !m.heavy())) return {};
  return m;
}

Noise noise_of(const MeasurementSet& set, const std::vector<VectorXd>& misfits) {
  if (set.imaging.noise_sigma_m) return {set.imaging.noise_sigma_m, true, "declared", {}};
  Mean along;
  for (std::size_t i = 0; i < set.experiments.size(); ++i)
    for (const MeasuredCurve& curve : measured_curves(set.experiments[i]))
      add_point_to_point(curve, free_numbers(set.experiments[i]), misfits[i], along);
  if (along.count >= 10) return {std::sqrt(along.sum / along.count), false, "point to point", {}};
  const Mean repeats = over_repeats(set);
  if (repeats.count >= 6) return {std::sqrt(repeats.sum / repeats.count), false, "repeats", {}};
  return {{}, false, "unknown", {}};
}

std::optional<Correlation> correlation_along(const MeasurementSet& set, const std::vector<VectorXd>& misfits) {
  double products = 0, squares = 0, pairs = 0, numbers = 0;
  for (std::size_t i = 0; i < set.experiments.size(); ++i)
    for (const MeasuredCurve& curve : measured_curves(set.experiments[i])) {
      const auto first = static_cast<Eigen::Index>(curve.first),
                 end = first + static_cast<Eigen::Index>(curve.from_tip_m.size());
      for (Eigen::Index k = first; k + 1 < end; ++k) {
        products += misfits[i].segment<3>(3 * k).dot(misfits[i].segment<3>(3 * k + 3));
        squares += (misfits[i].segment<3>(3 * k).squaredNorm() + misfits[i].segment<3>(3 * k + 3).squaredNorm()) / 2;
        pairs += 1, numbers += free_numbers(set.experiments[i]);
      }
    }
  if (pairs < 5 || squares == 0) return {};
  const double value = products / squares;
  return Correlation{value, value * std::sqrt(numbers)};
}

}  // namespace ostium::data
