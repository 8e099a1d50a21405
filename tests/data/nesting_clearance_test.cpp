/// Play between nested instruments against two beams, each with its own deflection, that touch where they meet.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "data/effects/effect.h"
#include "data/forward/shape.h"
#include "tests/support/synthetic_set.h"

namespace ostium {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Beams {
  double outer_EI, inner_EI, outer_k, inner_k, outer_m, inner_m;
};

/// Small deflection of the inner beam's tip: both clamped, never further apart than `play`; the energy's minimum under
/// these inequalities by augmented Lagrangians on a grid.
double tip_of_two_beams(const Beams& b, double play, int n) {
  const double h = b.inner_m / n;
  const int m = static_cast<int>(std::lround(b.outer_m / h));
  const auto curvature = [&](int nodes) {
    MatrixXd A = MatrixXd::Zero(nodes, nodes);
    for (int i = 0; i < nodes; ++i) {
      if (i >= 2) A(i, i - 2) = 1;
      if (i >= 1) A(i, i - 1) = -2;
      A(i, i) = i == 0 ? 2 : 1;  // no slope at the base
    }
    return MatrixXd(A / (h * h));
  };
  const auto weight = [&](int nodes) {
    VectorXd w = VectorXd::Constant(nodes, h);
    w[0] = h / 2;
    return w;
  };
  const MatrixXd outer = curvature(m), inner = curvature(n);
  const VectorXd of_outer = weight(m), of_inner = weight(n);
  MatrixXd K = MatrixXd::Zero(m + n, m + n);
  K.topLeftCorner(m, m) = b.outer_EI * outer.transpose() * of_outer.asDiagonal() * outer;
  K.bottomRightCorner(n, n) = b.inner_EI * inner.transpose() * of_inner.asDiagonal() * inner;
  VectorXd f(m + n), w = VectorXd::Zero(m + n), force = VectorXd::Zero(m);
  f << b.outer_EI * b.outer_k * outer.transpose() * of_outer, b.inner_EI * b.inner_k * inner.transpose() * of_inner;
  const double penalty = 1e5 * b.outer_EI / std::pow(b.outer_m, 3);
  for (int round = 0; round < 2000; ++round) {
    for (int pass = 0; pass < 40; ++pass) {
      MatrixXd A = K;
      VectorXd right = f;
      for (int i = 0; i < m; ++i) {
        const double t = force[i] + penalty * (w[i] - w[m + i]);
        if (std::fabs(t) <= penalty * play) continue;
        A(i, i) += penalty, A(m + i, m + i) += penalty, A(i, m + i) -= penalty, A(m + i, i) -= penalty;
        const double pull = penalty * std::copysign(play, t) - force[i];
        right[i] += pull, right[m + i] -= pull;
      }
      const VectorXd next = A.ldlt().solve(right);
      const double moved = (next - w).cwiseAbs().maxCoeff();
      w = next;
      if (moved < 1e-12) break;
    }
    double change = 0;
    for (int i = 0; i < m; ++i) {
      const double t = force[i] + penalty * (w[i] - w[m + i]);
      const double next = std::fabs(t) > penalty * play ? t - std::copysign(penalty * play, t) : 0;
      change = std::max(change, std::fabs(next - force[i]));
      force[i] = next;
    }
    if (change < 1e-9) break;
  }
  return w[m + n - 1];
}

double tip_of_the_model(const Beams& b, double play) {
  MeasurementSet set = synthetic::two_tubes(1);
  set.imaging = {};
  set.gravity_m_s2.setZero();
  const double EI[] = {b.outer_EI, b.inner_EI}, k[] = {b.outer_k, b.inner_k}, inserted[] = {b.outer_m, b.inner_m};
  Experiment& e = set.experiments[0];
  e.tip_force_N.setZero();
  for (int i = 0; i < 2; ++i) {
    for (Section& s : set.instruments[i].sections) {
      s.EI1_N_m2 = s.EI2_N_m2 = EI[i], s.GJ_N_m2 = EI[i] / 1.4;
      s.rest_curvature_per_m = {0, k[i], 0};
    }
    e.set[i] = {inserted[i], 0, 0};
  }
  Changes changes;
  changes.effects = {active(find_effect("nesting_clearance"), set, {}, {"", {}})};
  changes.effects[0].values[0] = 1e3 * play;
  const Shape shape = shape_from(setup_of(set, e, changes), walk(set, changes)[0]);
  EXPECT_TRUE(shape.converged);
  const Eigen::Quaterniond base(e.base.q_W[0], e.base.q_W[1], e.base.q_W[2], e.base.q_W[3]);
  return (base.conjugate() * (shape.points_m.back() - e.base.p_W)).x();
}

/// What play takes off the tip's deflection, over deflections small enough for beams: within an eighth.
TEST(NestingClearance, TakesAsMuchOffTheTipAsBetweenTwoBeamsThatTouch) {
  for (const auto& [outer_k, inner_k] : {std::pair(1.0, 0.0), std::pair(1.0, -0.6), std::pair(0.6, 1.0)})
    for (const double play : {1e-5, 3e-5}) {
      const Beams beams{5.5e-3, 2.6e-3, outer_k, inner_k, 0.1, 0.14};
      const double rigid = (beams.outer_EI * outer_k + beams.inner_EI * inner_k) / (beams.outer_EI + beams.inner_EI);
      const double without = rigid * 0.1 * (0.05 + 0.04) + inner_k * 0.04 * 0.04 / 2;
      EXPECT_NEAR(tip_of_the_model(beams, 0), without, 0.01 * std::fabs(without));
      const double exact = tip_of_two_beams(beams, play, 70) - without;
      const double model = tip_of_the_model(beams, play) - tip_of_the_model(beams, 0);
      EXPECT_NEAR(model / exact, 1, 0.125) << outer_k << " " << inner_k << " " << play;
    }
}

/// Curvatures that agree, turned alike, have no use for play; turned apart they have.
TEST(NestingClearance, ActsOnWhatDiffers) {
  MeasurementSet set = synthetic::two_tubes(1);
  for (MeasuredInstrument& i : set.instruments)
    for (Section& s : i.sections) s.rest_curvature_per_m = {0, 10, 0};
  Changes changes;
  changes.effects = {active(find_effect("nesting_clearance"), set, {}, {"", {}})};
  changes.effects[0].values[0] = 0.1;
  Experiment e = set.experiments[0];
  e.set = {{0.1, 0.3, 0}, {0.14, 0.3 + 3.14159265, 0}};
  const double apart = setup_of(set, e, changes).nest.parts[0].inserted_m;
  EXPECT_NEAR(apart, 0.1 - std::sqrt(3 * 0.1e-3 / 20), 1e-6);
}

}  // namespace
}  // namespace ostium
