/// Softening in bending: identities of the law, and that it does not change a rod without softening.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>

#include "core/model/rod.h"

namespace ostium::core {
namespace {

Superelastic law_of(double K1, double K2, double kc, double ratio) {
  Superelastic law;
  law.resize(4);
  const double length = 2e-3;
  law.set_cell(0, length, length * Eigen::Vector3d(1 / K1, 1 / K2, 1 / 30e-6),
               {length * Eigen::Vector2d(1 / kc, 1 - ratio), {}});
  return law;
}

V3<double> moment(const Superelastic& law, double x, double y, double z) {
  return law.operator()<double>({x, y, z}, 0).moment;
}

TEST(Softening, MomentIsTheSlopeOfEnergyAndTangentThatOfMoment) {
  const Superelastic law = law_of(40e-6, 25e-6, 30, 0.2);
  for (const auto& [x, y, z] :
       {std::array{1.0, -2.0, 3.0}, std::array{40.0, 10.0, -5.0}, std::array{-300.0, 200.0, 0.0}}) {
    const double h = 1e-4;
    const auto e = [&](double a, double b, double c) { return law.energy({a, b, c}, 0); };
    const auto [m, C] = law.operator()<double>({x, y, z}, 0);
    EXPECT_NEAR(m.x, (e(x + h, y, z) - e(x - h, y, z)) / (2 * h), 1e-7 * 40e-6 * 300);
    EXPECT_NEAR(m.y, (e(x, y + h, z) - e(x, y - h, z)) / (2 * h), 1e-7 * 40e-6 * 300);
    EXPECT_NEAR(m.z, 30e-6 * z, 1e-12);
    EXPECT_NEAR(C.xx, (moment(law, x + h, y, z).x - moment(law, x - h, y, z).x) / (2 * h), 1e-11);
    EXPECT_NEAR(C.xy, (moment(law, x, y + h, z).x - moment(law, x, y - h, z).x) / (2 * h), 1e-11);
    EXPECT_NEAR(C.yy, (moment(law, x, y + h, z).y - moment(law, x, y - h, z).y) / (2 * h), 1e-11);
    EXPECT_GT(C.xx * C.yy - C.xy * C.xy, 0);
  }
}

/// Below the softening curvature as stiff as before; far beyond it a straight line with the smaller slope.
TEST(Softening, HasTheTwoSlopesThatItIsGiven) {
  const Superelastic law = law_of(40e-6, 40e-6, 30, 0.2);
  EXPECT_NEAR(moment(law, 0.1, 0, 0).x / 0.1, 40e-6, 1e-9);
  EXPECT_NEAR((moment(law, 31000, 0, 0).x - moment(law, 30000, 0, 0).x) / 1000, 0.2 * 40e-6, 1e-11);
  // At the curvature where both slopes would meet, the moment is (r + (1 - r) / sqrt 2) of the linear one.
  EXPECT_NEAR(moment(law, 30, 0, 0).x, 30 * 40e-6 * (0.2 + 0.8 / std::sqrt(2.0)), 1e-12);
}

TEST(Softening, ARodHasTheLawOnlyWhereItIsAskedFor) {
  RodDescription d{
      "wire", {round_section(0, 0.2, 0.18e-3, 0, 60e9, 0.3, 6450)}, std::vector<double>(100, 2e-3), {}, {}};
  EXPECT_TRUE(std::holds_alternative<LinearElastic>(make_rod(d).law));
  const Eigen::Vector3d linear = stiffness_at_rest(make_rod(d), 50);
  d.sections[0].softening_per_m = 50, d.sections[0].softened_ratio = 0.3;
  const Rod rod = make_rod(d);
  ASSERT_TRUE(std::holds_alternative<Superelastic>(rod.law));
  EXPECT_LT((stiffness_at_rest(rod, 50) - linear).norm(), 1e-12 * linear.norm());
  d.sections[0].softened_ratio = 0;
  EXPECT_THROW(make_rod(d), std::invalid_argument);
  d.sections[0].softened_ratio = 0.5, d.sections[0].softening_per_m = -1;
  EXPECT_THROW(make_rod(d), std::invalid_argument);
}

}  // namespace
}  // namespace ostium::core
