/// A node that is pressed deep, by planes that a wall has or by planes that none has.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/base/tolerances.h"
#include "core/base/units.h"
#include "core/contact/contact.h"
#include "core/math/rotation.h"
#include "core/rod/initial_state.h"
#include "core/samples/steel_wire.h"
#include "core/samples/tube.h"
#include "core/step/step.h"

namespace ostium::core {
namespace {

using Eigen::Vector3d;

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

}  // namespace
}  // namespace ostium::core
