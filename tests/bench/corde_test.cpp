#include "tests/bench/corde.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/units.h"

namespace ostium::bench {
namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using units::pi;

CordeSettings test_rod(int elements, double step_s) {
  CordeSettings s;
  s.elements = elements;
  s.step_s = step_s;
  return s;
}
double EI(const CordeSettings& s) { return s.E_Pa * pi / 4.0 * std::pow(s.radius_m, 4); }
double GJ(const CordeSettings& s) { return EI(s) / (1.0 + s.nu); }  // G = E / 2(1 + nu), J = 2 I
double weight(const CordeSettings& s) {
  return s.density_kg_m3 * pi * s.radius_m * s.radius_m * s.length_m * s.gravity_m_s2.norm();
}
double twist_speed(const CordeSettings& s) { return std::sqrt(0.5 * s.E_Pa / (1.0 + s.nu) / s.density_kg_m3); }

/// Turns element i by `total` (i + 1/2) / n about a world axis: constant curvature or twist from the clamp on.
void turn_evenly(Corde& rod, double total, const Vector3d& axis) {
  const int n = rod.settings().elements;
  for (int i = 0; i < n; ++i) rod.set_frame(i, Quaterniond(AngleAxisd(total * (i + 0.5) / n, axis)) * rod.frame(i));
}

TEST(Corde, BentEvenlyCarriesMomentEITimesCurvature) {
  Corde rod(test_rod(64, 1e-6));
  const double angle = 0.5;
  turn_evenly(rod, angle, Vector3d::UnitY());  // downwards, since x turns to -z about y; d2 is y
  const double expected = EI(rod.settings()) * angle / rod.settings().length_m;
  for (int i = 0; i < 64; ++i) {
    // u = (2 / l) sin(theta / 2) falls short of theta / l by theta^2 / 24, here 2.5e-6.
    EXPECT_NEAR(rod.moment_N_m(i)[1], expected, 3e-6 * expected);
    EXPECT_NEAR(rod.moment_N_m(i)[0], 0.0, 1e-12 * expected);
    EXPECT_NEAR(rod.moment_N_m(i)[2], 0.0, 1e-12 * expected);
  }
}

TEST(Corde, TwistedEvenlyCarriesTorqueGJThetaOverL) {
  Corde rod(test_rod(64, 1e-6));
  const double angle = pi;
  turn_evenly(rod, angle, Vector3d::UnitX());
  const double expected = GJ(rod.settings()) * angle / rod.settings().length_m;
  for (int i = 0; i < 64; ++i) {
    EXPECT_NEAR(rod.moment_N_m(i)[2], expected, 1.1e-4 * expected);  // (pi / 64)^2 / 24 = 1.0e-4
    EXPECT_NEAR(rod.moment_N_m(i).head<2>().norm(), 0.0, 1e-12 * expected);
  }
}

TEST(Corde, TwistWaveReachesTheEndInTime) {
  // Released from a uniform twist, the end keeps its speed until the wave from the clamp arrives: it passes zero at L /
  // c.
  CordeSettings s = test_rod(64, 4e-6);
  s.gravity_m_s2.setZero();
  Corde rod(s);
  turn_evenly(rod, 0.1, Vector3d::UnitX());
  const Quaterniond straight = Corde(s).frame(63);
  double t = 0.0;
  while ((rod.frame(63) * straight.conjugate()).x() > 0.0 && t < 0.01) rod.step(), t += s.step_s;
  EXPECT_NEAR(t, s.length_m / twist_speed(s), 1.0 / 64 * s.length_m / twist_speed(s));  // within one element
}

TEST(Corde, ShortCantileverSwingsAboutItsStaticDeflection) {
  CordeSettings s = test_rod(32, 1.4e-6);
  s.length_m = 0.1;
  Corde rod(s);
  // Euler-Bernoulli: first frequency (1.8751 / L)^2 sqrt(EI / rho A), static tip w L^4 / 8 EI (0.26 mm).
  const double mass_per_m = weight(s) / s.gravity_m_s2.norm() / s.length_m;
  const double period = 2.0 * pi / (std::pow(1.8751 / s.length_m, 2) * std::sqrt(EI(s) / mass_per_m));
  const double tip = weight(s) * std::pow(s.length_m, 3) / (8.0 * EI(s));
  const int steps = static_cast<int>(std::lround(period / s.step_s));
  double mean = 0.0, half = 0.0;
  for (int i = 0; i < steps; ++i) {
    rod.step();
    mean -= rod.tip().z() / steps;
    if (i == steps / 2) half = -rod.tip().z();
  }
  EXPECT_NEAR(mean, tip, 0.005 * tip);
  // The first mode carries 97 % of it; the phases of the others, a few per cent in all, are unknown.
  EXPECT_NEAR(half, 2.0 * tip, 0.04 * tip);
  EXPECT_NEAR(-rod.tip().z(), 0.0, 0.04 * tip);
}

TEST(Corde, FallsLikeTheConvergedRod) {
  // Reference: the rod gate 0.3 s after release, 200 elements, adaptive and second-order integrators.
  const auto error = [](int elements) {
    Corde rod(test_rod(elements, 3e-6));
    for (int i = 0; i < 100000; ++i) rod.step();
    EXPECT_NEAR(rod.tip().y(), 0.0, 1e-12);
    EXPECT_LT(std::fabs(rod.stretch_percent()), 1e-6);  // 1G
    EXPECT_LT(rod.misalignment(), 1e-4);
    return (rod.tip() - Vector3d(0.79467, 0.0, -0.57652)).norm();
  };
  const double coarse = error(32), fine = error(64);
  EXPECT_LT(fine, 0.8e-3);
  EXPECT_NEAR(coarse / fine, 4.0, 1.0);  // second order in the element length
}

TEST(Corde, FrameAloneMovesLikeAFreeTop) {
  CordeSettings s = test_rod(4, 1e-5);
  s.gravity_m_s2.setZero();
  s.E_Pa = s.alignment_N = 1e-30;
  s.inertia = FrameInertia::cross_section;
  Corde rod(s);
  // J = J1 diag(1, 1, 2): the frame turns about its angular momentum at |L| / J1, and about d3 at -omega_3.
  const Vector3d omega(1.0, 0.0, 2.0);
  const Quaterniond start = rod.frame(2);
  rod.set_spin(2, omega);
  for (int i = 0; i < 100000; ++i) rod.step();
  const Vector3d momentum(1.0, 0.0, 4.0);
  const Quaterniond expected = start * Quaterniond(AngleAxisd(momentum.norm(), momentum.normalized())) *
                               Quaterniond(AngleAxisd(-omega[2], Vector3d::UnitZ()));
  EXPECT_LT(rod.frame(2).angularDistance(expected), 1e-4);  // first order in h: 1 s of some 4 rad/s
}

TEST(Corde, KeepsItsEnergyInThreeDimensions) {
  // A twisted rod thrown obliquely at ten g, so that torsion and both bending directions are coupled; nothing
  // dissipates.
  const auto gain_J = [](double step_s) {
    CordeSettings s = test_rod(16, step_s);
    s.gravity_m_s2 = {0.0, 49.0, -98.1};
    Corde rod(s);
    turn_evenly(rod, 2.0, Vector3d::UnitX());
    const double start = rod.energy_J();
    for (double t = 0.0; t < 0.2; t += step_s) rod.step();
    EXPECT_GT(rod.tip().y(), 0.2);
    return rod.energy_J() - start;
  };
  // Semi-implicit Euler's error is proportional to h; any residual at h = 0 would mean forces that are not the energy's
  // gradient (without p x M: 21e-6 J). The fall converts some tenths of a joule.
  EXPECT_NEAR(2.0 * gain_J(1e-6) - gain_J(2e-6), 0.0, 5e-6);
}

TEST(Corde, StepIsLimitedByTwistAndFailsBeyond) {
  const CordeSettings s = test_rod(64, 1e-6);
  const double step = largest_stable_step(s);
  const double twist_limit = s.length_m / 64 / twist_speed(s);  // h 2 c / l = 2
  EXPECT_LT(step, 1.005 * twist_limit);
  EXPECT_GT(step, 0.93 * twist_limit);  // 5 % for K_p, 0.5 % for the bisection
  EXPECT_TRUE(is_stable(s, step, 0.3));
  EXPECT_FALSE(is_stable(s, 3.0 * step, 0.02));
}

TEST(Corde, ManyLocalSweepsBecomeTheGlobalSolve) {
  CordeSettings s = test_rod(8, 2e-5);
  Corde global(s);
  s.stretch = Stretch::local, s.local_sweeps = 500;
  Corde local(s);
  for (int i = 0; i < 5000; ++i) global.step(), local.step();
  for (int i = 0; i <= 8; ++i) EXPECT_NEAR((global.position(i) - local.position(i)).norm(), 0.0, 1e-9);
}

TEST(Corde, LocalStretchGrowsWithElementsAndWithTheStepSquared) {
  const auto stretch = [](int n, double step_s, Stretch kind) {
    const CordeSettings s = soft_rod(n, step_s, kind);
    return stretch_percent(s, swing_s(s));
  };
  const double one = stretch(64, 2.5e-3, Stretch::local);
  EXPECT_NEAR(stretch(128, 2.5e-3, Stretch::local) / one, 2.0, 0.4);
  EXPECT_NEAR(stretch(64, 1.25e-3, Stretch::local) / one, 0.25, 0.05);
  EXPECT_LT(stretch(64, 2.5e-3, Stretch::global), 0.01 * one);
  EXPECT_GT(stretch(64, 2.5e-3, Stretch::penalty), 0.05 * one);
}

}  // namespace
}  // namespace ostium::bench
