/// Clearance of nested instruments against two beams, and two chains, each with its own deflection and in contact where
/// they meet.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "core/base/units.h"
#include "data/identification/effects/beams_with_play.h"
#include "data/identification/effects/effect_list.h"
#include "data/identification/forward/curve.h"
#include "data/identification/forward/shape.h"
#include "tests/support/nested_chains.h"
#include "tests/support/sets/synthetic_set.h"
#include "tests/support/sets/undeclared_tube.h"

namespace ostium::data {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Beams {
  double outer_EI, inner_EI, outer_k, inner_k, outer_m, inner_m;
};

/// Small deflection of the inner beam's tip: both clamped, never farther apart than `play`; the energy minimum under
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
    for (core::Section& s : set.instruments[i].sections) {
      s.EI1_N_m2 = s.EI2_N_m2 = EI[i], s.GJ_N_m2 = EI[i] / 1.4;
      s.rest_curvature_per_m = {0, k[i], 0};
    }
    e.set[i] = {inserted[i], 0, 0};
  }
  Changes changes;
  changes.effects = {active(find_effect("nesting_clearance"), set, {}, {"", {}})};
  changes.effects[0].values[0] = 1e3 * play;
  const PredictedShape shape = shape_from(setup_of(set, e, changes), walk(set, changes)[0]);
  EXPECT_TRUE(shape.converged);
  const Eigen::Quaterniond base(e.base.q_W[0], e.base.q_W[1], e.base.q_W[2], e.base.q_W[3]);
  return (base.conjugate() * (shape.points_m.back() - e.base.p_W)).x();
}

/// Reduction of the tip's deflection by play, for deflections small enough for beam theory.
TEST(NestingClearance, TakesAsMuchOffTheTipAsBetweenTwoBeamsThatTouch) {
  for (const auto& [outer_k, inner_k] : {std::pair(1.0, 0.0), std::pair(1.0, -0.6), std::pair(0.6, 1.0)})
    for (const double play : {1e-5, 3e-5}) {
      const Beams beams{5.5e-3, 2.6e-3, outer_k, inner_k, 0.1, 0.14};
      const double rigid = (beams.outer_EI * outer_k + beams.inner_EI * inner_k) / (beams.outer_EI + beams.inner_EI);
      const double without = rigid * 0.1 * (0.05 + 0.04) + inner_k * 0.04 * 0.04 / 2;
      EXPECT_NEAR(tip_of_the_model(beams, 0), without, 0.01 * std::fabs(without));
      const double exact = tip_of_two_beams(beams, play, 70) - without;
      const double model = tip_of_the_model(beams, play) - tip_of_the_model(beams, 0);
      EXPECT_NEAR(model / exact, 1, 0.02) << outer_k << " " << inner_k << " " << play;
    }
}

/// In a uniform nest, d crosses the bore at the end with a slope of sqrt(3 play differ).
TEST(NestingClearance, BeamsComeOutAtTheAngleOfTheClosedForm) {
  for (const double play : {1e-5, 1e-4})
    for (const double differ : {1.0, 5.0}) {
      BeamsWithPlay beams;
      beams.cell_m = 0.1 / 200, beams.play_m = play;
      beams.EI_r_N_m2.assign(200, 1.8e-3);
      beams.differ_per_m.assign(200, {0.6 * differ, -0.8 * differ});
      const Offsets d = offsets_of(beams);
      const Eigen::Vector2d towards(0.6, -0.8);
      EXPECT_NEAR(d.tip_slope.dot(towards) / std::sqrt(3 * play * differ), 1, 0.01) << play << " " << differ;
      EXPECT_NEAR(d.tip_m.dot(towards) / play, 1, 0.01) << play << " " << differ;
    }
}

/// The line of two tubes, the outer one's and then the inner one's, against two planar chains: large bends, tubes
/// curved to the same side and to opposite sides.
TEST(NestingClearance, LinesAgreeWithTwoChains) {
  constexpr double play = 0.1e-3, curved_m[] = {0.05, 0.042}, bend_per_m[] = {11, 6}, inserted_m[] = {0.075, 0.1};
  for (const bool opposed : {false, true}) {
    MeasurementSet set = synthetic::two_tubes(1);
    set.imaging = {};
    set.gravity_m_s2.setZero();
    Experiment& e = set.experiments[0];
    e.base = synthetic::base_along_x({0, 0});
    e.tip_force_N = {0, 0, 0.1};
    nested_chains::Problem pair;
    pair.play_m = play, pair.tip_force_N = {0, 0.1};
    for (int i = 0; i < 2; ++i) {
      auto& s = set.instruments[i].sections;
      s[0].to_tip_m = s[1].from_tip_m = curved_m[i];
      s[0].rest_curvature_per_m = {0, bend_per_m[i], 0};
      const bool turned = opposed && i == 1;
      e.set[i] = {inserted_m[i], turned ? units::pi : 0, 0};
      (i == 0 ? pair.outer : pair.inner) = {
          {{curved_m[i], s[0].EI1_N_m2, turned ? -bend_per_m[i] : bend_per_m[i]}, {1, s[1].EI1_N_m2, 0}},
          inserted_m[i]};
    }
    const nested_chains::Solution chains = nested_chains::solve(pair);
    ASSERT_TRUE(chains.converged);
    Changes none, changes;
    changes.effects = {active(find_effect("nesting_clearance"), set, {}, {"", {}})};
    changes.effects[0].values[0] = 1e3 * play;
    const PredictedShape with = shape_from(setup_of(set, e, changes), walk(set, changes)[0]),
                         without = shape_from(setup_of(set, e, none), walk(set, none)[0]);
    double off = 0, off_without = 0;
    for (std::size_t k = 0; k < chains.inner.size(); ++k) {
      // The transition from the outer to the inner centreline takes two steps.
      if (k + 8 >= chains.outer.size() && k < chains.outer.size() + 8) continue;
      const Eigen::Vector2d& p = k < chains.outer.size() ? chains.outer[k] : chains.inner[k];
      const Eigen::Vector3d q(p.x(), 0, p.y());
      off = std::max(off, (nearest_point(with.points_m, q) - q).norm());
      off_without = std::max(off_without, (nearest_point(without.points_m, q) - q).norm());
    }
    EXPECT_LT(off, 0.025e-3) << opposed;
    EXPECT_GT(off_without, 0.4e-3) << opposed;
  }
}

}  // namespace
}  // namespace ostium::data
