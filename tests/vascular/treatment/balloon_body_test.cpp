/// A balloon's body in its artery: the wall's law round a circle that lies aside, its shaft, friction by Coulomb, and
/// what its stiffness does in a bend.
#include "vascular/treatment/balloon_body.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "tests/vascular/treatment/treatment_bench.h"
#include "vascular/treatment/pressurised_tube.h"

namespace ostium::vascular {
namespace {

using Eigen::Vector2d;
using units::pi;

/// W by a hundred thousand strips.
CircleAside by_strips(const WallLaw& wall, double from_m, double a, double y) {
  constexpr int strips = 100000;
  CircleAside out;
  const double elsewhere_Pa = wall.at(from_m).p_Pa;
  for (int i = 0; i < strips; ++i) {
    const double f = 2 * pi * (i + 0.5) / strips, r = a + y * std::cos(f);
    if (r <= from_m) continue;
    out.back_N_m += (wall.at(r).p_Pa - elsewhere_Pa) * std::cos(f) * a * 2 * pi / strips;
  }
  return out;
}

TEST(BalloonBody, TheWallPushesBackAsItsLawDoesRoundTheCircle) {
  const Bench bench({.stenosis = 0.5});
  for (int cell : {60, 100}) {  // healthy, and plaque
    const WallLaw wall = wall_law(bench.model.plaque, bench.state.wall, cell);
    for (double wider_mm : {-0.3, -0.05, 0.0, 0.1, 0.4})
      for (double aside_mm : {0.02, 0.1, 0.35}) {
        const double a = wall.rest_m + wider_mm * mm, y = aside_mm * mm;
        const CircleAside is = press_circle(wall, wall.rest_m, a, y), asked = by_strips(wall, wall.rest_m, a, y);
        EXPECT_NEAR(is.back_N_m, asked.back_N_m, 0.05 * asked.back_N_m + 1e-9)
            << cell << " " << wider_mm << " " << aside_mm;
      }
  }
  // All round, a law that is straight: W = pi a E y / healthy.
  const WallLaw straight{.healthy_m = 1, .rest_m = 1e-3, .open_m = 1e-3, .E_Pa = 1e8, .yield_Pa = 1e12};
  EXPECT_NEAR(press_circle(straight, 1e-3, 1.5e-3, 0.2e-3).back_N_m, pi * 1.5e-3 * 1e8 * 0.2e-3, 1);
}

/// In a straight artery; its shaft lies aside by that, all along.
Bench with_shaft_aside(double aside_mm, double balloon_mm, std::array<Vector2d, 2 * balloon_spheres>& of) {
  Bench bench({.stenosis = 0, .balloon_mm = balloon_mm});
  of.fill(Vector2d::Zero());
  for (int i = 0; i < balloon_spheres; ++i) of[i].x() = aside_mm * mm;
  bench.device.balloons[0].shaft.aside_m = std::span(of).first(balloon_spheres);
  bench.device.balloons[0].shaft.bend_1_m = std::span(of).last(balloon_spheres);
  return bench;
}

TEST(BalloonBody, LiesOnItsShaftUntilTheWallPushesItToTheMiddle) {
  std::array<Vector2d, 2 * balloon_spheres> of;
  Bench bench = with_shaft_aside(0.9, 3, of);
  const auto middle_mm = [&] { return bench.state.balloons[0].aside_m[balloon_spheres / 2].x() / mm; };
  bench.run(0.4, 3);  // not unfolded: it hangs on its shaft
  EXPECT_GT(middle_mm(), 0.6);
  EXPECT_LT(bench.report.balloons[0].aside_N, 0.05);
  bench.run(8, 6);  // as wide as the artery
  EXPECT_LT(std::fabs(middle_mm()), 0.02);
  EXPECT_GT(bench.state.balloons[0].aside_m.front().x(), 0.1 * mm) << "its shaft pulls at its ends";
  // What the wall pushes with, the two bonds bear.
  const BalloonState& s = bench.state.balloons[0];
  const double bonds_N =
      s.bonds_N_m[0] * (of[0].x() - s.bonds_m[0].x()) + s.bonds_N_m[1] * (of[0].x() - s.bonds_m[1].x());
  EXPECT_GT(bonds_N, 0.05);
  EXPECT_NEAR(bench.report.balloons[0].aside_N, bonds_N, 0.05 * bonds_N);
}

TEST(BalloonBody, IsHeldByCoulombOnACylinder) {
  std::array<Vector2d, 2 * balloon_spheres> of;
  Bench bench = with_shaft_aside(0, 3.5, of);
  bench.device.balloons[0].shaft.holds_N_m = std::numeric_limits<double>::infinity();
  bench.model.balloons[0].friction = 0.06;
  const double at_m = bench.device.balloons[0].shaft.middle_m, bond_N_m = bench.model.balloons[0].bond_N_m;
  bench.run(6, 12);
  ASSERT_TRUE(bench.state.balloons[0].held);
  EXPECT_LT(std::fabs(bench.slip_m()), 0.05 * mm);
  const double holds_N = 0.06 * bench.report.balloons[0].pressed_N;
  ASSERT_GT(holds_N, 0.3);
  ASSERT_LT(holds_N, 2.5) << "more than its shaft bears";
  // Pulled by nine tenths of that it stays; by twice it comes along, until what is left is what holds it.
  bench.device.balloons[0].shaft.middle_m = at_m - 0.9 * holds_N / bond_N_m;
  bench.run(6, 2);
  EXPECT_LT(std::fabs(bench.state.balloons[0].seat_m - at_m), 0.05 * holds_N / bond_N_m);
  bench.device.balloons[0].shaft.middle_m = at_m - 2 * holds_N / bond_N_m;
  bench.run(6, 2);
  EXPECT_NEAR(bond_N_m * bench.slip_m(), 0.06 * bench.report.balloons[0].pressed_N, 0.05 * holds_N);
  bench.run(-1, 15);  // emptied, it is where its shaft is
  EXPECT_FALSE(bench.state.balloons[0].held);
  EXPECT_EQ(bench.slip_m(), 0);
}

// An artery that is a sinusoid, without wrinkles: EI (u + y'')'' + K y = 0, so that y = EI q^2 u / (EI q^4 + K).
TEST(BalloonBody, LiesAsideInABendAsATubeOnTheWallDoes) {
  std::array<Vector2d, 2 * balloon_spheres> of;
  Bench bench(
      {.stenosis = 0, .balloon_length_mm = 60, .change = [](TreatmentModel& m) { m.balloons[0].bond_N_m = 1; }});
  const BalloonModel& own = bench.model.balloons[0];
  const double length_m = own.length_m + 2 * own.shoulder_m, q = 2 * pi / 16e-3;
  for (int i = 0; i < balloon_spheres; ++i) {
    const double s_m = length_m * (static_cast<double>(i) / (balloon_spheres - 1) - 0.5);
    of[i] = Vector2d::Zero(), of[balloon_spheres + i] = Vector2d(5 * std::cos(q * s_m), 0);
  }
  bench.device.balloons[0].shaft.aside_m = std::span<const Vector2d>(of).first(balloon_spheres);
  bench.device.balloons[0].shaft.bend_1_m = std::span<const Vector2d>(of).last(balloon_spheres);
  bench.run(8, 8);
  const BalloonState& s = bench.state.balloons[0];
  const int at = balloon_spheres / 2;
  const double a = s.radius_m[at], y = s.aside_m[at].x();
  const int cell = bench.model.paths[0].cells[bench.model.paths[0].at(sphere_position(own, s, at)).index];
  const WallLaw wall = wall_law(bench.model.plaque, bench.state.wall, cell);
  const double K = press_circle(wall, wall.rest_m, a, 1e-6).back_N_m / 1e-6,
               EI = pressurised_tube(a, s.pressure_Pa, skin_N_m(own)).EI_N_m2;
  const double u = of[balloon_spheres + at].x(), asked_m = EI * q * q * u / (EI * q * q * q * q + K);
  EXPECT_GT(asked_m, 0.002 * mm);
  EXPECT_NEAR(y, asked_m, 0.1 * asked_m);
}

}  // namespace
}  // namespace ostium::vascular
