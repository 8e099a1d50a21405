#include "data/identification/residuals/residual_tests.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "core/math/dense.h"
#include "data/identification/measurement/measured_curves.h"

namespace ostium::data {

namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int stretches = 6;  // per measured curve
constexpr int draws = 3999;
constexpr double level = 0.01;  // significance level of all tests together

/// One row per experiment: its mean misfit in each stretch of each curve, rotated by `turn`.
template <class Turn>
MatrixXd summary(const MeasurementSet& set, const std::vector<VectorXd>& misfits, Turn&& turn) {
  const auto& all = set.experiments;
  const auto views = static_cast<Eigen::Index>(std::max<std::size_t>(set.views.size(), 1));
  const bool curves = !measured_curves(all[0]).empty();
  MatrixXd rows = MatrixXd::Zero(all.size(), curves ? 3 * stretches * views : misfits[0].size());
  for (std::size_t e = 0; e < all.size(); ++e) {
    if (misfits[e].size() == 1) rows(e, 0) = misfits[e][0];
    if (misfits[e].size() == 3 && !curves) rows.row(e) = turn(all[e], Vector3d(misfits[e])).transpose();
    for (const MeasuredCurve& curve : measured_curves(all[e])) {
      const auto n = static_cast<Eigen::Index>(curve.from_tip_m.size()), first = static_cast<Eigen::Index>(curve.first);
      VectorXd count = VectorXd::Zero(stretches);
      const auto stretch_of = [&](Eigen::Index i) { return (n - 1 - i) * stretches / n; };
      for (Eigen::Index i = 0; i < n; ++i) count[stretch_of(i)] += 1;
      for (Eigen::Index i = 0; i < n; ++i)
        rows.row(e).segment<3>(3 * (curve.view * stretches + stretch_of(i))) +=
            turn(all[e], Vector3d(misfits[e].segment<3>(3 * (first + i)))).transpose() / count[stretch_of(i)];
    }
  }
  return rows;
}

double common_share(const MatrixXd& rows) {
  return rows.colwise().sum().squaredNorm() / static_cast<double>(rows.rows()) / rows.squaredNorm();
}

/// Orthonormal basis of the column space of `with`, centred.
MatrixXd basis(const MatrixXd& with) { return core::orthonormal_of_range(with.rowwise() - with.colwise().mean()); }

/// Share of the scatter of `rows` about their mean that lies in the span of `basis`.
double linear_share(const MatrixXd& centred_rows, const MatrixXd& basis) {
  return (basis.transpose() * centred_rows).squaredNorm() / centred_rows.squaredNorm();
}

/// p-value of the common share, by random sign flips.
double p_of_common(const MatrixXd& rows, std::mt19937& random) {
  const double found = common_share(rows);
  int as_large = 1;
  for (int d = 0; d < draws; ++d) {
    MatrixXd other = rows;
    for (Eigen::Index e = 0; e < rows.rows(); ++e)
      if (random() & 1u) other.row(e) *= -1;
    as_large += common_share(other) >= found;
  }
  return static_cast<double>(as_large) / (draws + 1);
}

/// p-value of the linear share, by permuting the experiments.
ResidualTest linear(const std::string& on, const MatrixXd& rows, const MatrixXd& with, std::mt19937& random) {
  const MatrixXd along = basis(with), centred = rows.rowwise() - rows.colwise().mean();
  const double found = linear_share(centred, along);
  std::vector<int> order(rows.rows());
  std::iota(order.begin(), order.end(), 0);
  int as_large = 1;
  for (int d = 0; d < draws; ++d) {
    // Fisher-Yates, so that the draw does not depend on the library's shuffle.
    for (std::size_t i = order.size() - 1; i > 0; --i) std::swap(order[i], order[random() % (i + 1)]);
    as_large += linear_share(centred(order, Eigen::all), along) >= found;
  }
  return {on, found, static_cast<double>(as_large) / (draws + 1), false};
}

struct Covariate {
  std::string name;
  MatrixXd columns;
};

/// The quantities that were varied; those that do not vary are left out.
std::vector<Covariate> covariates(const MeasurementSet& set) {
  const auto& all = set.experiments;
  const auto n = static_cast<Eigen::Index>(all.size()), tools = static_cast<Eigen::Index>(set.instruments.size());
  Covariate roll{"roll", MatrixXd(n, 2 * tools)}, insertion{"insertion", MatrixXd(n, tools)},
      load{"load", MatrixXd(n, 3)}, time{"elapsed time", MatrixXd(n, 1)}, order{"order", MatrixXd(n, 1)},
      turning{"direction of roll", MatrixXd::Zero(n, tools)}, feeding{"direction of feed", MatrixXd::Zero(n, tools)},
      place{"place", MatrixXd(n, 3)};
  const auto sign = [](double x) { return x > 0 ? 1.0 : x < 0 ? -1.0 : 0.0; };
  for (Eigen::Index e = 0; e < n; ++e) {
    const Experiment& x = all[e];
    for (Eigen::Index i = 0; i < tools; ++i) {
      roll.columns(e, 2 * i) = std::cos(x.set[i].roll_rad), roll.columns(e, 2 * i + 1) = std::sin(x.set[i].roll_rad);
      insertion.columns(e, i) = x.set[i].inserted_m;
      if (e == 0) continue;
      turning.columns(e, i) = sign(x.set[i].roll_rad - all[e - 1].set[i].roll_rad);
      feeding.columns(e, i) = sign(x.set[i].inserted_m - all[e - 1].set[i].inserted_m);
    }
    load.columns.row(e) = x.tip_force_N.transpose();
    time.columns(e, 0) = std::log1p(x.elapsed_s.value_or(0) / 60);
    order.columns(e, 0) = static_cast<double>(e);
    place.columns.row(e) = x.points_m.empty() ? Eigen::RowVector3d::Zero() : x.points_m.back().transpose().eval();
  }
  std::vector<Covariate> list;
  for (Covariate* c : {&roll, &insertion, &load, &time, &order, &turning, &feeding, &place}) {
    const MatrixXd off = c->columns.rowwise() - c->columns.colwise().mean();
    if (off.squaredNorm() < 1e-18 || c->columns.cols() + 3 > n) continue;
    list.push_back(*c);
  }
  return list;
}

/// The shortest stretch, in tenths of the instrument, that holds four fifths of the sum of squares.
std::optional<Eigen::Vector2d> where(const MeasurementSet& set, const std::vector<VectorXd>& misfits) {
  constexpr int parts = 10;
  double longest = 0;
  for (const Experiment& e : set.experiments) longest = std::max(longest, e.set.back().inserted_m);
  VectorXd squares = VectorXd::Zero(parts);
  for (std::size_t e = 0; e < misfits.size(); ++e) {
    const std::vector<MeasuredCurve> curves = measured_curves(set.experiments[e]);
    if (curves.empty()) return {};
    for (const MeasuredCurve& curve : curves)
      for (std::size_t i = 0; i < curve.from_tip_m.size(); ++i) {
        const int part = std::min(parts - 1, static_cast<int>(parts * curve.from_tip_m[i] / longest));
        squares[part] += misfits[e].segment<3>(3 * static_cast<Eigen::Index>(curve.first + i)).squaredNorm();
      }
  }
  for (int length = 1; length <= parts; ++length)
    for (int first = 0; first + length <= parts; ++first)
      if (squares.segment(first, length).sum() >= 0.8 * squares.sum())
        return Eigen::Vector2d(first * longest / parts, (first + length) * longest / parts);
  return {};
}

/// Frame suggested by the strongest dependence. What is constant in the rolled frame turns with the roll in the set's
/// frame, and vice versa. Place correlates with most varied quantities, so it counts only if nothing else does.
std::string frame_of(const std::vector<ResidualTest>& strongest_first) {
  static const std::vector<std::pair<std::string, std::string>> frames = {{"common in the rolled frame", "material"},
                                                                          {"roll", "material"},
                                                                          {"common in the frame of the set", "lab"},
                                                                          {"roll, in the rolled frame", "lab"},
                                                                          {"load", "lab"},
                                                                          {"elapsed time", "time"},
                                                                          {"order", "time"}};
  std::string frame = "none";
  for (const ResidualTest& d : strongest_first) {
    if (!d.significant) continue;
    for (const auto& [on, meaning] : frames)
      if (d.on == on) return meaning;
    if (d.on.starts_with("place")) frame = "image";
  }
  return frame;
}

Eigen::Quaterniond base_of(const Experiment& e) { return {e.base.q_W[0], e.base.q_W[1], e.base.q_W[2], e.base.q_W[3]}; }

}  // namespace

ResidualTests residual_tests(const MeasurementSet& set, const std::vector<VectorXd>& misfits,
                             const MeasuredView& view) {
  ResidualTests out;
  if (set.experiments.size() < 4) return out;
  for (std::size_t e = 1; e < misfits.size(); ++e)
    if (set.experiments[e].kind != set.experiments[0].kind) return out;  // mixed kinds cannot be compared
  const MatrixXd lab =
      summary(set, misfits, [&](const Experiment&, const Vector3d& v) -> Vector3d { return view.R.conjugate() * v; });
  const MatrixXd material = summary(set, misfits, [&](const Experiment& e, const Vector3d& v) -> Vector3d {
    const Eigen::AngleAxisd unrolled(-e.set.back().roll_rad, Vector3d::UnitZ());
    return unrolled * (base_of(e).conjugate() * (view.R.conjugate() * v));
  });
  if (lab.squaredNorm() == 0) return out;
  std::mt19937 random(20250101);
  const bool vectors = misfits[0].size() > 1;
  if (vectors) {
    out.list.push_back({"common in the frame of the set", common_share(lab), p_of_common(lab, random), false});
    out.list.push_back({"common in the rolled frame", common_share(material), p_of_common(material, random), false});
  }
  for (const Covariate& c : covariates(set)) {
    out.list.push_back(linear(c.name, lab, c.columns, random));
    if (vectors) out.list.push_back(linear(c.name + ", in the rolled frame", material, c.columns, random));
  }
  for (ResidualTest& d : out.list) d.significant = d.p_value * static_cast<double>(out.list.size()) <= level;
  std::stable_sort(out.list.begin(), out.list.end(),
                   [](const ResidualTest& a, const ResidualTest& b) { return a.share > b.share; });
  out.signature.frame = frame_of(out.list);
  out.signature.from_tip_m = where(set, misfits);
  return out;
}

}  // namespace ostium::data
