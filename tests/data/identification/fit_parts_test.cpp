/// Folds, noise, residual tests and workers, each with numbers computed by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "data/formats/plot.h"
#include "data/identification/estimation/folds.h"
#include "data/identification/minimisation/secant_descent.h"
#include "data/identification/parallel/workers.h"
#include "data/identification/residuals/noise.h"
#include "data/identification/residuals/residual_tests.h"

namespace ostium::data {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

MeasurementSet of_groups(const std::vector<std::string>& groups) {
  MeasurementSet set;
  for (const std::string& group : groups) {
    Experiment e;
    e.group = group;
    e.set.resize(1);
    set.experiments.push_back(e);
  }
  return set;
}

using Folds = std::vector<std::vector<int>>;

TEST(Folds, AreContiguousAndKeepGroupsWhole) {
  EXPECT_EQ(folds_of(of_groups(std::vector<std::string>(8))), (Folds{{0, 1}, {2, 3}, {4, 5}, {6, 7}}));
  EXPECT_EQ(folds_of(of_groups(std::vector<std::string>(5))), (Folds{{0, 1}, {2}, {3}, {4}}));
  EXPECT_EQ(folds_of(of_groups(std::vector<std::string>(3))), (Folds{{0}, {1}, {2}}));
  EXPECT_EQ(folds_of(of_groups({""})), Folds{});
  // Fewer than eight groups: one fold each, wherever their members are listed.
  EXPECT_EQ(folds_of(of_groups({"a", "b", "a", "c", "b"})), (Folds{{0, 2}, {1, 4}, {3}}));
  EXPECT_EQ(folds_of(of_groups({"a", "b", "c", "d", "e", "f", "g", "h"})), (Folds{{0, 1}, {2, 3}, {4, 5}, {6, 7}}));
}

double normal(std::mt19937& random) {
  const double u = (random() + 0.5) / 4294967296.0, v = (random() + 0.5) / 4294967296.0;
  return std::sqrt(-2 * std::log(u)) * std::cos(6.283185307179586 * v);
}

/// A cubic misfit is ignored, noise across the wire is measured.
TEST(Noise, PointToPointDoesNotSeeASmoothMisfit) {
  std::mt19937 random(3);
  MeasurementSet set = of_groups({"", "", "", ""});
  std::vector<VectorXd> misfits;
  for (Experiment& e : set.experiments) {
    VectorXd off(3 * 80);
    for (int i = 0; i < 80; ++i) {
      e.points_m.push_back(Vector3d(0, 0, 3e-3 * i));
      const double s = i / 80.0, bend = 5e-3 * s * s * s - 2e-3 * s;
      off.segment<3>(3 * i) = Vector3d(bend + 0.2e-3 * normal(random), 0.2e-3 * normal(random), 0);
    }
    misfits.push_back(off);
  }
  const Noise noise = noise_of(set, misfits);
  ASSERT_TRUE(noise.sigma_m);
  EXPECT_NEAR(*noise.sigma_m, 0.2e-3, 0.03e-3);
  EXPECT_EQ(noise.from, "point to point");
  EXPECT_GT(correlation_along(set, misfits)->standard_errors, 10);
}

TEST(Noise, RepeatsTellThatOfTips) {
  MeasurementSet set = of_groups({"", "", "", "", ""});
  const double x[] = {0, 2e-3, 4e-3, 7e-3, 9e-3};  // repeats: three, then two
  for (int i = 0; i < 5; ++i) {
    set.experiments[i].kind = Experiment::Kind::tip;
    set.experiments[i].points_m = {Vector3d(x[i], 0, 0)};
    set.experiments[i].set[0].inserted_m = i < 3 ? 0.1 : 0.2;
  }
  const Noise noise = noise_of(set, {});
  ASSERT_TRUE(noise.sigma_m);
  // Sums of squares about the means: 8 and 2 mm2, over 2 and 1 repeats of three coordinates.
  EXPECT_NEAR(*noise.sigma_m, std::sqrt(10e-6 / 9), 1e-12);
  set.experiments.resize(1);
  EXPECT_FALSE(noise_of(set, {}).sigma_m);
}

/// Misfits that turn with the roll are constant in the material frame; those that do not, in the set's frame.
TEST(ResidualTest, TellsTheMaterialFrameFromTheSets) {
  for (bool material : {true, false}) {
    std::mt19937 random(5);
    MeasurementSet set = of_groups(std::vector<std::string>(16));
    std::vector<VectorXd> misfits;
    for (std::size_t i = 0; i < 16; ++i) {
      Experiment& e = set.experiments[i];
      e.kind = Experiment::Kind::tip;
      e.set[0].roll_rad = 2.4 * static_cast<double>(i);
      const double angle = material ? e.set[0].roll_rad : 0.4;
      const Vector3d off(std::cos(angle) + 0.3 * normal(random), std::sin(angle) + 0.3 * normal(random), 0);
      e.points_m = {Vector3d(0.1, 0.2, 0.3)};
      misfits.push_back(1e-3 * off);
    }
    EXPECT_EQ(residual_tests(set, misfits, {}).signature.frame, material ? "material" : "lab");
    for (VectorXd& m : misfits) m = 1e-3 * VectorXd::NullaryExpr(3, [&](Eigen::Index) { return normal(random); });
    EXPECT_EQ(residual_tests(set, misfits, {}).signature.frame, "none");
  }
}

TEST(Workers, KeepTheOrderAndPassOnWhatIsThrown) {
  for (int threads : {1, 4}) {
    const auto results = Workers(threads).map(100, [](std::size_t i) { return std::vector<double>(i % 3, double(i)); });
    for (std::size_t i = 0; i < 100; ++i) EXPECT_EQ(results[i], std::vector<double>(i % 3, double(i)));
    EXPECT_THROW(Workers(threads).map(9,
                                      [](std::size_t i) -> std::vector<double> {
                                        if (i == 5) throw std::runtime_error("five");
                                        return {};
                                      }),
                 std::runtime_error);
  }
}

TEST(Plot, WordsAreEscapedAndEmptyPlotsAreDrawn) {
  Plot plot("a < b & c", "x", "y");
  EXPECT_NE(plot.svg().find("a &lt; b &amp; c"), std::string::npos);
  plot.line({{1, 1}, {1, 1}}, "#000");
  EXPECT_EQ(plot.svg().find("nan"), std::string::npos);
  EXPECT_EQ(plot.svg().find("inf"), std::string::npos);
}

/// A curved valley crossed by a bound, and a free number: the minimum is found in few evaluations.
TEST(SecantDescent, FindsTheLeastOfACurvedValley) {
  SecantDescent d;
  d.problem.residuals = 3;
  d.problem.start = Eigen::Vector3d(-0.5, 0.5, 0);
  d.problem.least = Eigen::Vector3d(-2, -2, -9), d.problem.most = Eigen::Vector3d(2, 2, 9);
  d.problem.evaluate = [](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* J) {
    EXPECT_EQ(J, nullptr);
    r = Eigen::Vector3d(3 * (x[1] - x[0] * x[0]), 1 - x[0], x[2] - 4 * x[1]);
    return true;
  };
  d.dear = 2, d.scale = Eigen::Vector3d::Ones();
  d.last_radius = 1e-3, d.least_gain = 1e-9;
  const LeastSquaresResult free = minimise(d);
  EXPECT_LT((free.x - Eigen::Vector3d(1, 1, 4)).norm(), 1e-3);
  EXPECT_LE(free.iterations, d.most_evaluations);
  d.problem.most[0] = 0.5;  // then the minimum is at x = 1/2, y = 1/4
  const LeastSquaresResult bound = minimise(d);
  EXPECT_LT((bound.x - Eigen::Vector3d(0.5, 0.25, 1)).norm(), 1e-3);
}

}  // namespace
}  // namespace ostium::data
