#include "core/contact/contact.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>

#include "core/base/units.h"
#include "core/math/rotation.h"
#include "core/rod/initial_state.h"
#include "core/samples/steel_wire.h"
#include "core/samples/tube.h"
#include "core/wall/pose.h"
#include "core/wall/triangle.h"
#include "tests/support/nearest_corner.h"

namespace ostium::core {
namespace {

using Eigen::Vector3d;

using units::pi;

SurfaceDescription straight_tube(double radius_m) {
  std::vector<TubePoint> points;
  for (int i = -2; i <= 30; ++i) points.push_back({Vector3d(0.01 * i, 0, 0), radius_m});
  return tube(points, 48);
}

TEST(Triangle, TheNearestPointIsNoFartherThanAnyOther) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> u(-1, 1);
  const auto any = [&] { return V3<double>{u(random), u(random), u(random)}; };
  for (int n = 0; n < 200; ++n) {
    const V3<double> a = any(), b = any(), c = any(), x = any();
    const auto apart = [&](const TrianglePoint& w) {
      const V3<double> d = at(w, a, b, c) - x;
      return std::sqrt(dot(d, d));
    };
    const TrianglePoint w = nearest(x, a, b, c);
    EXPECT_GE(w.u, 0);
    EXPECT_GE(w.v, 0);
    EXPECT_LE(w.u + w.v, 1 + 1e-12);
    double best = 1e9;
    for (int i = 0; i <= 60; ++i)
      for (int j = 0; i + j <= 60; ++j) best = std::min(best, apart({i / 60.0, j / 60.0}));
    EXPECT_LE(apart(w), best + 1e-12);
    EXPECT_GE(apart(w), best - 0.05);
  }
}

TEST(Surface, ATubeIsAsHollowAsItsRadiusSays) {
  const SurfaceDescription d = straight_tube(2e-3);
  const Surface surface = make_surface(d);
  for (const Surface::Triangle& t : surface.triangles) {
    const auto& corner = d.triangles[t.id];
    const auto p = [&](int k) { return from_eigen(d.frames[0][corner[k]]); };
    const Vector3d middle = (d.frames[0][corner[0]] + d.frames[0][corner[1]] + d.frames[0][corner[2]]) / 3;
    if (middle.x() < 0.05 || middle.x() > 0.25) continue;  // the ends are flat
    const Vector3d around = Vector3d::UnitX().cross(Vector3d(0, middle.y(), middle.z()).normalized());
    EXPECT_NEAR(curvature_towards(from_eigen(around), t, p(0), p(1), p(2)), 500, 10);
    EXPECT_NEAR(curvature_towards(V3<double>{1, 0, 0}, t, p(0), p(1), p(2)), 0, 10);
  }
}

/// Parts of a step continue from each other, also across the end of the cycle.
TEST(Surface, AMotionIsTheSumOfItsParts) {
  SurfaceMotion whole;
  whole.frame_before = 23.9, whole.frame_after = 0.1;
  whole.shift_after_W = Vector3d(0, 0, 1e-3);
  const SurfaceMotion first = part_of(whole, 24, 0, 0.5), second = part_of(whole, 24, 0.5, 1);
  EXPECT_EQ(first.frame_before, whole.frame_before);
  EXPECT_NEAR(first.frame_after, 24, 1e-12);
  EXPECT_EQ(second.frame_before, first.frame_after);
  EXPECT_NEAR(second.frame_after, 24.1, 1e-12);
  EXPECT_EQ(first.shift_before_W, Vector3d::Zero());
  EXPECT_NEAR(second.shift_after_W.z(), 1e-3, 1e-15);
  EXPECT_EQ(second.shift_before_W, first.shift_after_W);
  whole.sway_before = 0.2, whole.sway_after = 0.6;
  EXPECT_NEAR(part_of(whole, 24, 0, 0.5).sway_after, 0.4, 1e-15);
  EXPECT_EQ(part_of(whole, 24, 0.5, 1).sway_before, part_of(whole, 24, 0, 0.5).sway_after);
  EXPECT_NEAR(part_of(whole, 24, 0.5, 1).sway_after, 0.6, 1e-15);
}

/// Sideways bump along x of a wall with rings every 10 mm: linear in between.
double bump_m(double x) {
  const auto at_ring = [](double ring) { return 0.02 * std::pow(std::sin(pi * std::clamp(ring / 28, 0.0, 1.0)), 2); };
  const double ring = std::floor(100 * x), share = 100 * x - ring;
  return (1 - share) * at_ring(ring) + share * at_ring(ring + 1);
}

SurfaceDescription swaying_tube(double radius_m) {
  SurfaceDescription d = straight_tube(radius_m);
  for (const Vector3d& p : d.frames[0]) d.sway.emplace_back(0, bump_m(p.x() + 1e-9), 0);
  return d;
}

/// Every corner is at the described position at both ends of a step, and is found there.
TEST(Surface, WhatSwaysIsWhereItsDisplacementsSay) {
  const SurfaceDescription d = swaying_tube(2e-3);
  const Surface surface = make_surface(d);
  SurfacePose pose(surface);
  std::vector<int> found;
  found.reserve(surface.clusters.size());
  for (const auto& [before, after] :
       {std::pair{0.0, 0.0}, {0.0, 0.3}, {0.3, 0.9}, {1.0, 0.95}, {0.4, 0.0}, {0.7, 1.5}}) {
    SurfaceMotion motion;
    motion.sway_before = before, motion.sway_after = after;
    set_motion(surface, motion, pose);
    for (int v = 0; v < static_cast<int>(d.frames[0].size()); v += 7)
      for (const double sway : {before, after}) {
        const Vector3d p = d.frames[0][v] + Vector3d(0, sway * bump_m(d.frames[0][v].x() + 1e-9), 0);
        EXPECT_LT((p - vertex_at(d, v, 0, sway)).norm(), 1e-12);
        const V3<double> q = from_eigen(p), pad{1e-6, 1e-6, 1e-6};
        find_clusters(surface, q - pad, q + pad, pose, found);
        double nearest_m = 1;
        for (int c : found) {
          const ClusterPose& it = pose_of(surface, c, pose);
          nearest_m = std::min(nearest_m, test::nearest_corner_m(sway == before ? it.before : it.after, p));
        }
        EXPECT_LT(nearest_m, 1e-7) << "vertex " << v << " from " << before << " to " << after;
      }
  }
}

/// A part that stands still through the whole cycle is computed once, and again if the whole surface is shifted or
/// vertices are moved.
TEST(Surface, WhatStandsStillIsWhereItIsShifted) {
  SurfaceDescription d = straight_tube(2e-3);
  d.frames.resize(6, d.frames[0]);
  Surface surface = make_surface(d);
  SurfaceEditor editor(d, surface);
  SurfacePose pose(surface);
  const Vector3d to(1e-3, 2e-3, -1e-3);
  const int v = 40;
  Vector3d own = d.frames[0][v];
  const auto see = [&](const Vector3d& before, const Vector3d& after, const char* what) {
    SurfaceMotion motion;
    motion.frame_before = 2.4, motion.frame_after = 2.5, motion.shift_before_W = before, motion.shift_after_W = after;
    set_motion(surface, motion, pose);
    double off_before = 1, off_after = 1;
    for (int c = 0; c < static_cast<int>(surface.clusters.size()); ++c) {
      EXPECT_TRUE(surface.clusters[c].stands_still || own != d.frames[0][v]);
      off_before = std::min(off_before, test::nearest_corner_m(pose_of(surface, c, pose).before, own + before));
      off_after = std::min(off_after, test::nearest_corner_m(pose_of(surface, c, pose).after, own + after));
    }
    EXPECT_LT(off_before, 1e-7) << what;
    EXPECT_LT(off_after, 1e-7) << what;
  };
  const Vector3d none = Vector3d::Zero();
  for (const char* what : {"first", "again"}) see(none, none, what);
  see(none, to, "moves"), see(to, to, "has moved"), see(to, to, "stands there"), see(to, none, "back");
  see(none, none, "stands"), see(to, to, "leapt");
  own += Vector3d(0, 0.4e-3, 0);
  for (int f = 0; f < 6; ++f) editor.place(v, f, own);
  editor.refit();
  see(to, to, "placed anew");
}

TEST(Surface, RefusesWhatIsNoWall) {
  SurfaceDescription none;
  EXPECT_THROW(make_surface(none), std::invalid_argument);
  SurfaceDescription wrong = straight_tube(2e-3);
  wrong.triangles[7][1] = 100'000;
  EXPECT_THROW(make_surface(wrong), std::invalid_argument);
  SurfaceDescription uneven = straight_tube(2e-3);
  uneven.frames.push_back(uneven.frames[0]);
  uneven.frames[1].pop_back();
  EXPECT_THROW(make_surface(uneven), std::invalid_argument);
  SurfaceDescription infinite = straight_tube(2e-3);
  infinite.frames[0][3].x() = std::nan("");
  EXPECT_THROW(make_surface(infinite), std::invalid_argument);
  SurfaceDescription swaying = swaying_tube(2e-3);
  swaying.sway.pop_back();
  EXPECT_THROW(make_surface(swaying), std::invalid_argument);
}

/// A wire in a tube that moves 20 mm sideways four times a second, by more than its radius per step, moves with it and
/// stays inside; the tube's centre is known in closed form.
TEST(Contact, AWireGoesWithAWallThatSways) {
  Model model;
  RodDescription d = steel_wire({.elements = 200, .length_m = 0.2});
  d.damping.drag_across_N_s_m2 = 1;
  model.rods = {make_rod(d)};
  model.surfaces = {std::make_shared<Surface>(make_surface(swaying_tube(2e-3)))};
  State state = make_state(model, {along_x()});
  Inputs inputs;
  inputs.rods.resize(1), inputs.surfaces.resize(1);
  Scratch scratch(model);
  StepReport report;
  const double room_m = 2e-3 - d.sections[0].radius_m;
  const auto sway_at = [](int n) { return std::pow(std::sin(pi * n / 250), 2); };
  double off_m = 0, carried_m = 0;
  for (int n = 0; n < 750; ++n) {
    inputs.surfaces[0].sway_before = sway_at(n), inputs.surfaces[0].sway_after = sway_at(n + 1);
    step(model, inputs, state, scratch, report);
    for (int i = 1; i < model.rods[0].nodes(); ++i) {
      const Vector3d p = state.rods[0].position[i];
      off_m = std::max(off_m, std::hypot(p.y() - sway_at(n + 1) * bump_m(p.x()), p.z()) - room_m);
      carried_m = std::max(carried_m, p.y());
    }
  }
  EXPECT_LT(off_m, 0.5 * d.sections[0].radius_m);
  EXPECT_GT(carried_m, 0.016);
}

/// A soft wall yields by force over stiffness, also where neighbouring triangles are within reach.
TEST(Contact, ASoftWallYields) {
  SurfaceDescription wall = straight_tube(2e-3);
  wall.stiffness_N_m2 = 300;
  Model model;
  RodDescription d = steel_wire({.elements = 100, .length_m = 0.2});
  d.damping.drag_across_N_s_m2 = 1;
  model.rods = {make_rod(d)};
  model.surfaces = {std::make_shared<Surface>(make_surface(wall))};
  State state = make_state(model, {along_x()});
  Inputs inputs;
  inputs.rods.resize(1);
  inputs.rods[0].base.hold = Hold::free;
  Scratch scratch(model);
  StepReport report;
  for (int n = 0; n < 4000; ++n) step(model, inputs, state, scratch, report);
  const double yields = d.sections[0].kg_per_m * 9.81 / wall.stiffness_N_m2, radius = d.sections[0].radius_m;
  EXPECT_GT(yields, 50e-6);
  // In the groove between two sides of the tube, each pressed in by this much.
  const double side_m = 2e-3 * std::cos(pi / 48);
  EXPECT_NEAR(state.rods[0].position[50].z(), -(side_m - radius + yields) / std::cos(pi / 48), 0.03 * yields);
  double borne = 0;
  for (const Touch& t : report.touches) borne += t.normal_W_N.z();
  EXPECT_NEAR(borne / (model.rods[0].total_mass_kg * 9.81), 1, 0.01);
}

/// A wire that slides along a wall without friction does not feel the edges between triangles, however fast: at 100
/// mm/s it passes half a triangle per step.
TEST(Contact, EdgesOfASmoothWallAreNotFelt) {
  std::vector<TubePoint> points;
  for (double x = -5e-3; x < 80e-3; x += 0.2e-3) points.push_back({Vector3d(x, 0, 0), 1.5e-3});
  const SurfaceDescription wall = tube(points, 32);
  Model model;
  RodDescription d = steel_wire({.elements = 40, .length_m = 0.04});
  d.sections[0].radius_m = 0.18e-3;
  model.rods = {make_rod(d)};
  model.surfaces = {std::make_shared<Surface>(make_surface(wall))};
  EndState base = along_x();
  base.p_W.z() = d.sections[0].radius_m / std::cos(pi / 32) - 1.5e-3;  // in the groove between two sides
  State state = make_state(model, {base});
  Inputs inputs;
  inputs.rods.resize(1);
  Scratch scratch(model);
  StepReport report;
  double drag = 0, lift = 0;
  for (int n = 0; n < 400; ++n) {
    inputs.rods[0].base.velocity_W_m_s.x() = 0.1 * std::min(1.0, n / 200.0);
    step(model, inputs, state, scratch, report);
    for (const Touch& t : report.touches) drag = std::max(drag, -t.normal_W_N.x()), lift += t.normal_W_N.z() / 400;
  }
  const double weight = 9.81 * model.rods[0].total_mass_kg;
  EXPECT_GT(lift, 0.3 * weight) << "it lies on the wall";
  EXPECT_LT(drag, 1e-6 * weight);
}

/// A door across the middle of a tube: thin instruments pass it while it is open, and only then.
TEST(Contact, ADoorLetsThinInstrumentsThroughWhileItIsOpen) {
  SurfaceDescription wall = straight_tube(3e-3);
  constexpr double at_m = 0.1;
  constexpr int around = 24;
  const int rim = static_cast<int>(wall.frames[0].size());
  for (int j = 0; j <= around; ++j) {
    const double a = 2 * pi * j / around, r = j < around ? 3.2e-3 : 0;
    wall.frames[0].push_back({at_m, r * std::cos(a), r * std::sin(a)});
  }
  for (int j = 0; j < around; ++j) {
    wall.door.push_back(static_cast<int>(wall.triangles.size()));
    wall.triangles.push_back({rim + j, rim + (j + 1) % around, rim + around});  // facing away from the approaching wire
  }
  wall.door_passes_m = 0.46e-3;
  const RodDescription thin = steel_wire({.elements = 200, .E_Pa = 1e9, .length_m = 0.2, .gravity = false});
  RodDescription thick = thin;
  for (auto& section : thick.sections) section.radius_m = 0.47e-3;
  const auto tip_m = [&](const RodDescription& d, bool open, double push_s, double pull_s = 0) {
    Model model;
    model.gravity_W.setZero();
    model.rods = {make_rod(d)};
    model.surfaces = {std::make_shared<Surface>(make_surface(wall))};
    State state = make_state(model, {along_x()}, {0.08});
    Inputs inputs;
    inputs.rods.resize(1), inputs.surfaces.resize(1);
    inputs.surfaces[0].door_open = open;
    Scratch scratch(model);
    StepReport report;
    for (int n = 0; n < 1000 * (push_s + pull_s); ++n) {
      inputs.rods[0].feed_m_s = n < 1000 * push_s ? 0.1 : -0.1;
      step(model, inputs, state, scratch, report);
    }
    return state.rods[0].position[model.rods[0].elements].x();
  };
  EXPECT_NEAR(tip_m(thin, true, 0.4), 0.12, 0.2e-3);
  EXPECT_NEAR(tip_m(thin, true, 0.4, 0.4), 0.08, 0.2e-3) << "and back";
  EXPECT_NEAR(tip_m(thin, false, 0.21), at_m - 0.45e-3, 0.1e-3) << "a wall";
  EXPECT_NEAR(tip_m(thick, true, 0.21), at_m - 0.47e-3, 0.1e-3) << "and to what is too thick always";
  wall.door[0] = 100'000;
  EXPECT_THROW(make_surface(wall), std::invalid_argument);
}

}  // namespace
}  // namespace ostium::core
