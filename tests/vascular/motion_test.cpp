/// Timing, motion and splines of the cardiac cycle.
#include <gtest/gtest.h>

#include "core/base/units.h"
#include "vascular/geometry/implicit/spline.h"
#include "vascular/motion/heart_cycle.h"
#include "vascular/motion/moving_lumen.h"
#include "vascular/patient/wall.h"

namespace ostium::vascular {
namespace {

TEST(PeriodicPoints, ACircleComesBackFromTwentyFourOfItsPoints) {
  std::vector<std::vector<Eigen::Vector3d>> frames(beat_frames);
  const auto circle = [](double phase) {
    const double a = 2 * units::pi * phase;
    return Eigen::Vector3d(0.01 * std::cos(a), 0.3 + 0.01 * std::sin(a), -0.1);
  };
  for (int f = 0; f < beat_frames; ++f) frames[f] = {circle(static_cast<double>(f) / beat_frames)};
  const PeriodicPoints points(frames);
  for (double phase = -0.3; phase < 1.7; phase += 0.0317) {
    // The error of a cubic spline: h^4 / 384 of the fourth derivative, h = 2 pi / 24.
    EXPECT_LT((points.position(0, phase) - circle(phase)).norm(), 0.01 * std::pow(2 * units::pi / 24, 4) / 300);
    const double h = 1e-4;
    const Eigen::Vector3d slope = (points.position(0, phase + h) - points.position(0, phase - h)) / (2 * h);
    EXPECT_LT((points.velocity(0, phase) - slope).norm(), 1e-4);
  }
  for (int f = 0; f < beat_frames; ++f)
    EXPECT_LT((points.position(0, static_cast<double>(f) / beat_frames) - frames[f][0]).norm(), 5e-9);
}

TEST(PeriodicPoints, VelocityIsContinuousAcrossFramesAndTheCycle) {
  std::vector<std::vector<Eigen::Vector3d>> frames(beat_frames);
  for (int f = 0; f < beat_frames; ++f) frames[f] = {Eigen::Vector3d(f * f % 7, f % 5, 0)};
  const PeriodicPoints points(frames);
  for (int f = 0; f <= beat_frames; ++f) {
    const double at = static_cast<double>(f) / beat_frames;
    EXPECT_LT((points.velocity(0, at - 1e-9) - points.velocity(0, at + 1e-9)).norm(), 1e-3);
  }
}

TEST(HeartCycle, OneCycleTakesAMinuteOverTheRate) {
  for (double rate : {40.0, 70.0, 120.0, 180.0}) {
    double time = 0;
    constexpr int n = 100000;
    for (int i = 0; i < n; ++i) time += 1.0 / n / phase_speed((i + 0.5) / n, rate);
    EXPECT_NEAR(time, 60 / rate, 1e-8);
    EXPECT_NEAR(time_at(1, rate), 60 / rate, 1e-12);
    EXPECT_NEAR(time_at(0, rate), 0, 1e-12);
    // Bazett: systole as the root of the cycle, 309 ms at 70 a minute.
    EXPECT_NEAR(time_at(end_systole, rate), 0.36 * 60 / 70 * std::sqrt(70 / rate), 1e-9);
    for (double phase = 0; phase < 1; phase += 0.01) EXPECT_GT(phase_speed(phase, rate), 0);
  }
}

TEST(HeartCycle, ContractionIsPeriodicSmoothAndReachesOne) {
  double highest = 0, lowest = 1;
  for (double phase = 0; phase < 1; phase += 0.001) {
    highest = std::max(highest, contraction(phase));
    lowest = std::min(lowest, contraction(phase));
    const double before = contraction(phase - 1e-5), after = contraction(phase + 1e-5);
    EXPECT_LT(std::fabs(after - 2 * contraction(phase) + before), 400 * 1e-10);  // the second derivative is bounded
  }
  EXPECT_NEAR(highest, 1, 0.002);
  EXPECT_NEAR(lowest, 0, 0.005);
  EXPECT_NEAR(contraction(0), contraction(1), 1e-12);
  EXPECT_NEAR(contraction(0), 0, 1e-12);
}

TEST(Beat, TheGrooveDescendsTheApexRestsTheArchIsStill) {
  const Anatomy a = build_anatomy({});
  const HeartMotion motion(a.landmarks);
  const TubeMotion tubes(a, motion);
  const Eigen::Vector3d along = (a.landmarks.p_lv_apex - a.landmarks.p_lv_base).normalized();
  const auto moved = [&](const char* name, double fraction) {
    const NamedBranch& b = *find_branch(a, name);
    const double s = b.from_m + fraction * b.length_m();
    return Eigen::Vector3d(tubes.centre(b.tube, s, 9) - tubes.centre(b.tube, s, 0));
  };
  EXPECT_NEAR(moved("RCA", 0.6).dot(along), 22.5e-3, 4e-3);  // TAPSE 20 to 25 mm
  // The whole heart shifts by 4.5 mm (heart_motion.h); the apex moves little beyond that.
  EXPECT_LT(moved("LAD", 0.95).norm(), 7e-3);
  EXPECT_NEAR(moved("LM", 0.0).norm(), 10.5e-3,
              1e-3);  // 5 to 8 mm from memory; Mao's speed of the left main needs more
  EXPECT_LT((tubes.centre(0, 0.2, 9) - a.tubes[0].at(0.2).p).norm(), 1e-9);
  EXPECT_EQ(tubes.breath_share(0, 0.2), 0);
}

TEST(Beat, TheBranchPointsOfTheTreeStayTogether) {
  const Anatomy a = build_anatomy({});
  const HeartMotion motion(a.landmarks);
  const TubeMotion tubes(a, motion);
  for (std::size_t t = 1; t < a.tubes.size(); ++t) {
    const Tube& tube = a.tubes[t];
    if (!tubes.moves(static_cast<int>(t)) || tube.name.find("sinus") != std::string::npos) continue;
    const double s = nearest_s(a.tubes[tube.parent], tube.nodes.front().p);
    for (int f = 0; f < beat_frames; f += 3) {
      const double apart = (tubes.centre(static_cast<int>(t), 0, f) - tubes.centre(tube.parent, s, f)).norm();
      const double rest = (tube.nodes.front().p - a.tubes[tube.parent].at(s).p).norm();
      EXPECT_NEAR(apart, rest, 0.15e-3) << tube.name;
    }
  }
}

TEST(Wall, ContactSeesTheSameWallAsTheLumenBetweenFrames) {
  const Anatomy a = build_anatomy({});
  const HeartMotion motion(a.landmarks);
  // Only the right coronary artery, which moves fastest.
  const Tube& rca = a.tubes[find_branch(a, "RCA")->tube];
  Contour contour;
  for (double s = 20e-3; s < 90e-3; s += 5e-3) {
    contour.mesh.vertices.push_back(rca.at(s).p + 1.5e-3 * Eigen::Vector3d::UnitX());
    contour.shares.push_back({{find_branch(a, "RCA")->tube, s, 1}});
  }
  const MovingLumen lumen = make_moving_lumen(a, {}, motion, TubeMotion(a, motion), contour);
  const core::SurfaceDescription wall = wall_of(lumen);
  ASSERT_EQ(static_cast<int>(wall.frames.size()), beat_frames);
  double off = 0;
  for (std::size_t v = 0; v < lumen.vertices(); ++v)
    for (double phase = 0; phase < 1; phase += 0.003)
      off = std::max(off, (vertex_at(wall, static_cast<int>(v), frame_at(phase)) - lumen.healthy(v, phase, 0)).norm());
  // Two cubic splines through the same frames: half a percent of 25 mm.
  EXPECT_LT(off, 0.12e-3);
  EXPECT_GT(off, 0);
}

TEST(Breath, GoesDownAndForwardAsPublished) {
  const Anatomy a = build_anatomy({});
  const HeartMotion motion(a.landmarks);
  const Eigen::Vector3d middle = (a.landmarks.p_lv_base + a.landmarks.p_lv_apex) / 2;
  const Eigen::Vector3d moved = motion.breath_displacement(middle, 1);
  EXPECT_NEAR(moved.y(), -4.9e-3, 1e-12);
  EXPECT_NEAR(moved.z(), 1.3e-3, 1e-12);
  EXPECT_EQ(breath_depth(0), 0);
  EXPECT_NEAR(breath_depth(0.5), 1, 1e-12);
}

TEST(CurveSpline, GoesThroughItsPointsAndIsStraightOnALine) {
  const std::vector<Eigen::Vector3d> points = {{0, 0, 0}, {1, 2, 0}, {3, 1, 1}, {4, 4, 2}};
  const CurveSpline spline(points);
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_LT((spline.at(spline.knots()[i]) - points[i]).norm(), 1e-12);
  const CurveSpline line({{0, 0, 0}, {1, 1, 1}, {5, 5, 5}});
  EXPECT_LT((line.at(line.end() / 3) - Eigen::Vector3d::Constant(5.0 / 3)).norm(), 1e-12);
}

}  // namespace
}  // namespace ostium::vascular
