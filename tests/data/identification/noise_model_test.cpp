/// The noise model against noise that is made by a law, its sums against closed forms; and verdicts in degrees.
#include "data/identification/residuals/noise_model.h"

#include <gtest/gtest.h>

#include <cmath>

#include "data/identification/selection/degrees.h"
#include "data/identification/selection/verdict.h"
#include "data/identification/selection/verdict_text.h"
#include "tests/support/dice.h"
#include "tests/support/sets/synthetic_set.h"

namespace ostium::data {
namespace {

constexpr double spacing = 5e-3;

/// Twelve traces of 50 points of two components; `shared`: an Ornstein-Uhlenbeck process of this length.
std::vector<ResidualTrace> traces_of(unsigned seed, double sigma, double shared, double blunders) {
  synthetic::Dice dice("traces", seed);
  std::vector<ResidualTrace> out;
  for (int t = 0; t < 12; ++t) {
    ResidualTrace trace{Eigen::VectorXd(50), Eigen::MatrixXd(50, 2), 2};
    const double keeps = shared > 0 ? std::exp(-spacing / shared) : 0;
    for (int i = 0; i < 50; ++i) {
      trace.at[i] = spacing * i;
      for (int c = 0; c < 2; ++c) {
        const double own = sigma * dice.normal();
        trace.values(i, c) = i > 0 ? keeps * trace.values(i - 1, c) + std::sqrt(1 - keeps * keeps) * own : own;
      }
      if (dice.uniform(0, 1) < blunders) trace.values.row(i) *= 12;
    }
    out.push_back(trace);
  }
  return out;
}

TEST(NoiseModel, WhatIsAsDeclaredStaysSo) {
  int as_declared = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const NoiseModel m = noise_model_of(traces_of(seed, 2e-4, 0, 0), 2e-4);
    as_declared += m.as_declared && !m.correlated() && !m.heavy();
  }
  EXPECT_GE(as_declared, 19);
}

TEST(NoiseModel, ItsSizeIsFound) {
  const NoiseModel m = noise_model_of(traces_of(1, 4e-4, 0, 0), 2e-4);
  EXPECT_FALSE(m.as_declared);
  EXPECT_FALSE(m.correlated());
  EXPECT_FALSE(m.heavy());
  EXPECT_NEAR(m.sigma, 4e-4, 4 * 4e-4 / std::sqrt(2 * 1200.0));
  EXPECT_NE(in_words(m, 2e-4, 1e-3, "mm").find("times what is declared"), std::string::npos);
}

TEST(NoiseModel, HowFarNeighboursShareItIsFound) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const NoiseModel m = noise_model_of(traces_of(seed, 2e-4, 25e-3, 0), 2e-4);
    EXPECT_FALSE(m.as_declared);
    ASSERT_TRUE(m.correlated());
    EXPECT_FALSE(m.heavy());
    // About 1200 / 10 independent numbers tell it: a third is three standard errors.
    EXPECT_NEAR(m.length, 25e-3, 0.5 * 25e-3) << seed;
    EXPECT_NEAR(m.sigma, 2e-4, 0.3 * 2e-4) << seed;
  }
}

TEST(NoiseModel, BlundersAreTailsAndNotSize) {
  const NoiseModel m = noise_model_of(traces_of(3, 2e-4, 0, 0.03), 2e-4);
  EXPECT_FALSE(m.as_declared);
  EXPECT_TRUE(m.heavy());
  EXPECT_NEAR(m.sigma, 2e-4, 0.2 * 2e-4);
}

TEST(NoiseModel, SmoothNoiseHasALengthToo) {
  // A window over independent numbers, exp(-(d / length)^2): covariance exp(-(d / length)^2 / 2); and a little of each
  // point's own.
  synthetic::Dice dice("smooth", 1);
  std::vector<ResidualTrace> traces = traces_of(1, 1, 0, 0);
  constexpr int reach = 15;
  for (ResidualTrace& t : traces)
    for (int c = 0; c < 2; ++c) {
      std::vector<double> own(50 + 2 * reach);
      for (double& o : own) o = dice.normal();
      for (int i = 0; i < 50; ++i) {
        double sum = 0, squares = 0;
        for (int j = -reach; j <= reach; ++j) {
          const double weight = std::exp(-std::pow(j * spacing / 25e-3, 2));
          sum += weight * own[i + reach + j], squares += weight * weight;
        }
        t.values(i, c) = 2e-4 * (sum / std::sqrt(squares) + 0.2 * dice.normal());
      }
    }
  const NoiseModel m = noise_model_of(traces, 2e-4);
  EXPECT_TRUE(m.smooth);
  EXPECT_NEAR(m.length, 25e-3, 0.3 * 25e-3);
  EXPECT_NEAR(m.sigma, 2e-4, 0.3 * 2e-4);
}

/// A smooth error of every trace is no less correlated than such a noise: telling them apart is not this function's.
TEST(NoiseModel, TooFewPointsLeaveTheDeclaredOne) {
  std::vector<ResidualTrace> few = {traces_of(1, 9e-4, 0, 0)[0]};
  few[0].at = Eigen::VectorXd(few[0].at.head(20));
  few[0].values = Eigen::MatrixXd(few[0].values.topRows(20));
  EXPECT_TRUE(noise_model_of(few, 2e-4).as_declared);
}

TEST(NoiseModel, DecorrelatedNumbersHaveUnitVarianceAndTheRightSum) {
  for (const double degrees : {3.0, std::numeric_limits<double>::infinity()}) {
    NoiseModel m;
    m.sigma = 2e-4, m.length = 25e-3, m.degrees = degrees;
    const auto traces = traces_of(7, 2e-4, 25e-3, 0);
    // Of two neighbours: (b - phi a) / sqrt(1 - phi^2) in units of sigma.
    ResidualTrace pair{traces[0].at.head(2), traces[0].values.topRows(2), 2};
    NoiseModel normal = m;
    normal.degrees = std::numeric_limits<double>::infinity();
    const double phi = std::exp(-spacing / m.length);
    const Eigen::MatrixXd white = decorrelated(pair, normal);
    EXPECT_NEAR(white(1, 0), (pair.values(1, 0) - phi * pair.values(0, 0)) / std::sqrt(1 - phi * phi) / m.sigma, 1e-9);
    // Tails drawn in: the sum of squares differs from minus twice the log likelihood by what depends on no residual.
    double before = 0, after = 0;
    auto moved = traces;
    for (ResidualTrace& t : moved) t.values *= 1.3;
    for (const auto& t : traces) before += decorrelated(t, m).squaredNorm();
    for (const auto& t : moved) after += decorrelated(t, m).squaredNorm();
    EXPECT_NEAR(after - before, minus_two_log_likelihood(moved, m) - minus_two_log_likelihood(traces, m), 1e-6 * after);
  }
}

TEST(NoiseModel, TheExpectedSquareIsThatOfStudentsT) {
  NoiseModel m;
  EXPECT_EQ(expected_square(m, 2), 1);
  m.degrees = 5;
  EXPECT_NEAR(expected_square(m, 2), (5 + 2) / 5.0, 1e-7);  // E log(1 + F) of two components: 2 / degrees
}

TEST(NoiseModel, CorrelatedNumbersCountForFewer) {
  const auto traces = traces_of(1, 1, 25e-3, 0);
  NoiseModel m;
  m.sigma = 1;
  EXPECT_EQ(effective_numbers(traces, m), 12 * 50 * 2);
  m.length = 25e-3;  // the mean of 250 mm of it: length / (2 x 25 mm) and a little more
  EXPECT_NEAR(effective_numbers(traces, m), 12 * 2 * 250 / 50.0, 0.25 * 12 * 2 * 5);
}

TEST(Degrees, AShareIsOfWhatIsBeyondNoise) {
  EXPECT_NEAR(*share_removed({1100, 100}, {200, 100}), 0.9, 1e-12);
  EXPECT_EQ(*share_removed({1100, 100}, {80, 98}), 1);
  EXPECT_EQ(*share_removed({1100, 100}, {1500, 98}), 0);
  EXPECT_FALSE(share_removed({90, 100}, {80, 98}));
  EXPECT_TRUE(removes_most({1100, 100}, {200, 100}));
  EXPECT_FALSE(removes_most({1100, 100}, {300, 100}));
  EXPECT_EQ(rms_over_noise({400, 100}), 2);
}

FittedModel model_of(const std::vector<std::string>& effects, double chi2_per_dof, double held_out_m) {
  FittedModel m;
  m.effects = effects;
  for (const std::string& id : effects) m.name += (m.name.empty() ? "" : " + ") + id;
  m.degrees_of_freedom = 100, m.chi2_per_dof = chi2_per_dof, m.bic = 100 * chi2_per_dof + 5.0 * effects.size();
  m.rms_held_out_m = held_out_m;
  return m;
}

/// Chi-square 50, 4 and 3.9: an effect removes 94 %, another of what it leaves 3 % and is not named. A field with more
/// evidence, or an effect that removes half, leaves it unexplained.
TEST(Degrees, WhatRemovesMostIsNamedAndNoMore) {
  const MeasurementSet set = synthetic::free_wire(4);
  const Workers workers(1);
  Explanation x;
  x.noise = {1e-4, true, "declared", {}};
  x.declared = model_of({}, 50, 1e-3);
  x.candidates = {model_of({"registration", "self_weight"}, 3.9, 2e-4), model_of({"registration"}, 4, 2e-4)};
  Explanation most = x;
  decide(set, workers, most);
  EXPECT_EQ(most.verdict, Verdict::mostly);
  EXPECT_EQ(most.effects(), std::vector<std::string>{"registration"});
  EXPECT_EQ(most.best().chi2_per_dof, 4);

  Explanation field = x;
  field.attributions.resize(1);
  field.attributions[0].log_evidence = 3000;
  decide(set, workers, field);
  EXPECT_EQ(field.verdict, Verdict::unexplained);
  EXPECT_TRUE(field.effects().empty());

  Explanation half = x;
  half.candidates = {model_of({"registration"}, 25, 5e-4)};
  decide(set, workers, half);
  EXPECT_EQ(half.verdict, Verdict::unexplained);

  Explanation all = x;
  all.candidates = {model_of({"registration"}, 1, 1e-4)};
  decide(set, workers, all);
  EXPECT_EQ(all.verdict, Verdict::effect);
}

TEST(NoiseModel, OneFarLargerThanWhatIsLeftIsSuspicious) {
  EXPECT_EQ(doubt_of_noise(0.5, 100), "");
  EXPECT_EQ(doubt_of_noise(1e-4, 3), "") << "by chance";
  EXPECT_NE(doubt_of_noise(1e-4, 100).find("100 times what is left"), std::string::npos) << doubt_of_noise(1e-4, 100);
  FittedModel m;
  m.degrees_of_freedom = 100;
  std::vector<std::string> warnings;
  for (const double chi2 : {1.0, 1e-4}) m.chi2_per_dof = chi2, warn_of_scales(m, warnings);
  EXPECT_EQ(warnings.size(), 1u);
}

/// Three deviations of 30 %: a factor of 2.46.
TEST(Degrees, StiffnessFarFromWhatIsDeclaredIsSuspicious) {
  FittedModel m;
  Parameter scale;
  scale.name = "EI_scale[0]", scale.label = "stiffness of wire", scale.start = 1, scale.spread = 0.3;
  m.parameters = {{scale, 2.4, 0.1, 1}};
  std::vector<std::string> warnings;
  warn_of_scales(m, warnings);
  EXPECT_TRUE(warnings.empty());
  m.parameters[0].value = 2.6;
  warn_of_scales(m, warnings);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("stiffness of wire is 2.6 times"), std::string::npos) << warnings[0];
}

}  // namespace
}  // namespace ostium::data
