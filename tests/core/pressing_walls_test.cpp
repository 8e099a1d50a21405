/// Walls that press where there are none: a node that is pressed deep, and what lies beyond or beside a ridge.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "core/base/tolerances.h"
#include "core/base/units.h"
#include "core/contact/contact.h"
#include "core/math/rotation.h"
#include "core/rod/initial_state.h"
#include "core/samples/steel_wire.h"
#include "core/samples/tube.h"
#include "core/step/step.h"
#include "core/wall/surface.h"

namespace ostium::core {
namespace {

using Eigen::Vector3d;

using units::pi;

constexpr double pressing_tube_radius_m = 2e-3, wire_radius_m = 0.18e-3, pressed_m = 2 * tolerances::usable_depth_m;
constexpr int node = 20;

/// A wire in the middle of a tube, after a step.
struct WireInTube {
  Model model;
  State state;
  Inputs inputs;
  std::unique_ptr<Scratch> scratch;

  WireInTube() {
    std::vector<TubePoint> points;
    for (int i = -2; i <= 8; ++i) points.push_back({Vector3d(0.01 * i, 0, 0), pressing_tube_radius_m});
    model.gravity_W.setZero();
    RodDescription d = steel_wire({.elements = 40, .length_m = 0.04, .gravity = false});
    d.sections[0].radius_m = wire_radius_m;
    model.rods = {make_rod(d)};
    model.surfaces = {std::make_shared<Surface>(make_surface(tube(points, 48)))};
    EndState base;
    base.q_W = {std::sqrt(0.5), 0, std::sqrt(0.5), 0};  // d3 along x
    state = make_state(model, {base});
    inputs.rods.resize(1);
    scratch = std::make_unique<Scratch>(model);
    StepReport report;
    step(model, inputs, state, *scratch, report);
  }
  const Strand& strand() { return scratch->strands[0]; }
  Vector3d at() { return strand().s->position[node]; }
  NodeWalls& walls() { return strand().contact->walls[node]; }
  /// A plane that presses the node by that depth.
  WallPlane pressing(const Vector3d& normal) {
    WallPlane plane;
    plane.normal = from_eigen(normal);
    plane.place = normal.dot(at()) + pressed_m;
    plane.softness = 1e-5, plane.active = true;
    return plane;
  }
};

TEST(PressingWalls, PlanesOfNoWallAreDropped) {
  WireInTube wire;
  ASSERT_NEAR(wire.at().x(), 0.02, 1e-4) << "the middle of the tube, out of reach of its wall";
  wire.walls().count = 2;
  wire.walls().planes[0] = wire.pressing(Vector3d::UnitY());
  wire.walls().planes[1] = wire.pressing(-Vector3d::UnitY());
  EXPECT_TRUE(find_pressing_walls_anew(wire.model, wire.strand(), *wire.scratch));
  EXPECT_EQ(wire.walls().count, 0);
  EXPECT_FALSE(find_pressing_walls_anew(wire.model, wire.strand(), *wire.scratch)) << "once is enough";
}

TEST(PressingWalls, ThoseOfAWallStay) {
  WireInTube wire;
  const double side_m =
      pressing_tube_radius_m * std::cos(units::pi / 48);  // from the axis to the middle of a flat side
  const Vector3d out(0, std::cos(units::pi / 48), std::sin(units::pi / 48));
  const Vector3d pressed = Vector3d(0.02, 0, 0) + (side_m - wire_radius_m + pressed_m) * out;
  for (Field<3>* p : {&wire.strand().s->position, &wire.strand().own->position}) p->set(node, pressed);
  wire.walls().count = 1;
  wire.walls().planes[0] = wire.pressing(-out);
  EXPECT_FALSE(find_pressing_walls_anew(wire.model, wire.strand(), *wire.scratch));
  ASSERT_EQ(wire.walls().count, 1);

  // Beside it, a plane of no wall: both give way to what is there, which holds the node as the first one did.
  wire.walls().count = 2;
  wire.walls().planes[1] = wire.pressing(out);
  EXPECT_TRUE(find_pressing_walls_anew(wire.model, wire.strand(), *wire.scratch));
  double deepest_m = 0;
  for (int k = 0; k < wire.walls().count; ++k) {
    const WallPlane& plane = wire.walls().planes[k];
    EXPECT_LT(to_eigen(plane.normal).dot(out), 0) << k;
    if (plane.active) deepest_m = std::max(deepest_m, plane.place - to_eigen(plane.normal).dot(pressed));
  }
  EXPECT_NEAR(deepest_m, pressed_m, 1e-6);
}

/// A floor with a sharp drop on one side (y > 0), slightly rounded, its edge finely divided along x.
SurfaceDescription brink() {
  const double profile_m[][2] = {{-20e-3, 0}, {0, 0}, {0.018e-3, -0.05e-3}, {0.018e-3, -10e-3}};  // y, z
  constexpr int rows = 601;
  SurfaceDescription wall;
  wall.frames.resize(1);
  for (int i = 0; i < rows; ++i)
    for (const auto& [y, z] : profile_m) wall.frames[0].push_back({0.05e-3 * i - 5e-3, y, z});
  for (int i = 0; i + 1 < rows; ++i)
    for (int j = 0; j < 3; ++j) {
      const int a = 4 * i + j, b = a + 1, c = a + 4, d = a + 5;
      wall.triangles.push_back({a, b, d}), wall.triangles.push_back({a, d, c});
    }
  return wall;
}

/// A catheter that slides along the edge of a drop comes near faces below it that face away from it; they must not hold
/// it.
TEST(Contact, WhatLiesBeyondABrinkHoldsNothing) {
  Model model;
  RodDescription d = steel_wire({.elements = 20, .E_Pa = 1e9, .length_m = 0.02});
  d.sections[0].radius_m = 1e-3;
  d.damping.drag_across_N_s_m2 = 1;
  model.rods = {make_rod(d)};
  model.surfaces = {std::make_shared<Surface>(make_surface(brink()))};
  EndState base = along_x();
  base.p_W = Vector3d(0, -0.3e-3, 1e-3);
  State state = make_state(model, {base});
  Inputs inputs;
  inputs.rods.resize(1);
  Scratch scratch(model);
  StepReport report;
  for (int n = 0; n < 200; ++n) {
    inputs.rods[0].base.velocity_W_m_s.x() = 0.02 * std::min(1.0, n / 100.0);
    step(model, inputs, state, scratch, report);
    ASSERT_EQ(report.trouble, 0U) << "step " << n;
    for (int i = 0; i < model.rods[0].nodes(); ++i) {
      ASSERT_NEAR(state.rods[0].position[i].y(), base.p_W.y(), 1e-6) << "step " << n << ", node " << i;
      ASSERT_NEAR(state.rods[0].position[i].z(), base.p_W.z(), 1e-6) << "step " << n << ", node " << i;
    }
  }
}

/// A knife that stands in the lumen, its edge along x at the origin; in all frames but the first it is turned about it.
SurfaceDescription knife(double half_angle_rad, double turned_rad) {
  constexpr int rows = 30;
  SurfaceDescription wall;
  wall.frames.resize(6);
  for (std::size_t f = 0; f < wall.frames.size(); ++f) {
    const Eigen::AngleAxisd turn(f == 0 ? 0 : turned_rad, Vector3d::UnitX());
    for (int i = 0; i < rows; ++i)
      for (const double side : {-1.0, 0.0, 1.0})
        wall.frames[f].push_back(turn * Vector3d(0.7e-3 * i - 5e-3, side * 3e-3 * std::sin(half_angle_rad),
                                                 -std::fabs(side) * 3e-3 * std::cos(half_angle_rad)));
  }
  for (int i = 0; i + 1 < rows; ++i)
    for (int j = 0; j < 2; ++j) {
      const int a = 3 * i + j, b = a + 1, c = a + 3, d = a + 4;
      wall.triangles.push_back({a, b, d}), wall.triangles.push_back({a, d, c});
    }
  return wall;
}

/// A thorn in the lumen, its tip at the origin: faces as many as at a corner of a ridge, some of which a node beside
/// the tip sees edge on.
SurfaceDescription thorn(double half_angle_rad, std::mt19937& random) {
  constexpr int sides = 9;
  std::uniform_real_distribution<double> u(0, 1);
  SurfaceDescription wall;
  wall.frames.resize(1);
  wall.frames[0].emplace_back(Vector3d::Zero());
  for (int i = 0; i < sides; ++i) {
    const double a = 2 * pi * (i + 0.6 * u(random)) / sides, length_m = 1e-3 * (2 + u(random));
    wall.frames[0].push_back(length_m * Vector3d(std::sin(half_angle_rad) * std::cos(a),
                                                 std::sin(half_angle_rad) * std::sin(a), -std::cos(half_angle_rad)));
  }
  for (int i = 0; i < sides; ++i) wall.triangles.push_back({0, 1 + (i + 1) % sides, 1 + i});
  std::shuffle(wall.triangles.begin(), wall.triangles.end(), random);
  return wall;
}

/// Where the tip of a wire that comes along x lies beside a thorn's tip, it is in the lumen, from whichever side.
TEST(Contact, AThornHoldsNothingThatLiesBesideIt) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-1, 1);
  RodDescription d = steel_wire({.elements = 16, .length_m = 0.008, .gravity = false});
  d.sections[0].radius_m = 0.3e-3;
  for (int n = 0; n < 200; ++n) {
    Model model;
    model.gravity_W.setZero();
    model.rods = {make_rod(d)};
    SurfaceDescription wall = thorn(0.3, random);
    Vector3d points = Vector3d::UnitX();
    while (points.x() > -0.35)  // else the wire lies beside its flank, or where its foot is
      points = Vector3d(u(random), u(random), u(random)).normalized();
    const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), points);
    for (Vector3d& p : wall.frames[0]) p = turn * p + Vector3d(8.38e-3, 0, 0);
    model.surfaces = {std::make_shared<Surface>(make_surface(wall))};
    State state = make_state(model, {along_x()});
    Inputs inputs;
    inputs.rods.resize(1), inputs.surfaces.resize(1);
    Scratch scratch(model);
    StepReport report;
    step(model, inputs, state, scratch, report);
    EXPECT_TRUE(report.touches.empty()) << n << ": " << points.transpose();
  }
}

/// A wire beside a ridge, as sharp as a carina between two branches, is in the lumen wherever it lies round the edge,
/// and however the ridge has turned with the heart.
TEST(Contact, ASharpRidgeHoldsNothingThatLiesBesideIt) {
  const double half_angle = pi / 18;
  std::mt19937 order(1);
  RodDescription d = steel_wire({.elements = 16, .length_m = 0.008, .gravity = false});
  d.sections[0].radius_m = 0.3e-3;
  for (const double turned : {0.0, 0.9, 2.0, 3.1})
    for (double angle = half_angle + 1.0; angle < 2 * pi - half_angle - 1.0; angle += 0.07) {
      Model model;
      model.gravity_W.setZero();
      model.rods = {make_rod(d)};
      SurfaceDescription wall = knife(half_angle, turned);
      std::shuffle(wall.triangles.begin(), wall.triangles.end(), order);
      model.surfaces = {std::make_shared<Surface>(make_surface(wall))};
      EndState base = along_x();
      base.p_W = Eigen::AngleAxisd(turned + angle, Vector3d::UnitX()) * Vector3d(0, 0, -0.38e-3);
      State state = make_state(model, {base});
      Inputs inputs;
      inputs.rods.resize(1), inputs.surfaces.resize(1);
      inputs.surfaces[0].frame_before = inputs.surfaces[0].frame_after = 3;
      Scratch scratch(model);
      StepReport report;
      step(model, inputs, state, scratch, report);
      EXPECT_TRUE(report.touches.empty()) << "turned by " << turned << ", at " << angle;
      for (int i = 0; i < model.rods[0].nodes(); ++i)
        EXPECT_LT((state.rods[0].position[i] - base.p_W - Vector3d(0.5e-3 * i, 0, 0)).norm(), 1e-9);
    }
}

}  // namespace
}  // namespace ostium::core
