/// A rod fed into a passage of a rigid wall, somewhat narrower or somewhat wider than itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/base/tolerances.h"
#include "core/base/units.h"
#include "core/rod/initial_state.h"
#include "core/samples/steel_wire.h"
#include "core/samples/tube.h"
#include "core/step/step.h"

namespace ostium::core {
namespace {

using Eigen::Vector3d;

constexpr double rod_radius_m = 0.6e-3, tube_radius_m = 2e-3, middle_m = 0.05, half_length_m = 4.5e-3;

double radius_at(double x_m, double narrowest_m) {
  const double s = std::clamp((x_m - middle_m) / half_length_m, -1.0, 1.0);
  return tube_radius_m - (tube_radius_m - narrowest_m) * (0.5 + 0.5 * std::cos(units::pi * s));
}

struct Fed {
  double tip_m = 0;    ///< how far along the tube
  double push_N = 0;   ///< most that the hand felt
  double depth_m = 0;  ///< most that a node's ball lay beyond the tube's radius
};

/// Feeds a rod as stiff as a crimped stent at 20 mm/s until the hand feels 5 N or the tip is well beyond.
Fed feed_through(double narrowest_m) {
  std::vector<TubePoint> points;
  for (double x = -0.01; x < 0.1; x += 0.25e-3) points.push_back({Vector3d(x, 0, 0), radius_at(x, narrowest_m)});
  constexpr int around = 64;
  Model model;
  model.gravity_W.setZero();
  RodDescription d = steel_wire({.elements = 90, .length_m = 0.09, .gravity = false});
  d.sections[0].radius_m = rod_radius_m;
  d.sections[0].EI1_N_m2 = d.sections[0].EI2_N_m2 = 30e-6, d.sections[0].GJ_N_m2 = 20e-6;
  model.rods = {make_rod(d)};
  model.surfaces = {std::make_shared<Surface>(make_surface(tube(points, around)))};
  State state = make_state(model, {along_x()}, {0.03});
  Scratch scratch(model);
  Inputs inputs;
  inputs.rods.resize(1);
  inputs.rods[0].feed_m_s = 0.02;
  StepReport report;
  Fed fed;
  for (int n = 0; n < 2500 && fed.push_N < 5 && fed.tip_m < middle_m + 2 * half_length_m; ++n) {
    step(model, inputs, state, scratch, report);
    fed.push_N = std::max(fed.push_N, report.rods[0].push_N);
    fed.tip_m = state.rods[0].position[model.rods[0].elements].x();
    for (int i = state.rods[0].first; i <= model.rods[0].elements; ++i) {
      const Vector3d p = state.rods[0].position[i];
      const double flat = std::cos(units::pi / around);  // a side of the wall lies nearer than its corners
      fed.depth_m =
          std::max(fed.depth_m, std::hypot(p.y(), p.z()) + rod_radius_m - flat * radius_at(p.x(), narrowest_m));
    }
  }
  return fed;
}

/// A wall's stiffness is finite, so that a hard push squeezes a rod through. The hand does at least the work that it
/// takes to press the wall back at two opposite sides of the first node, over the way from where it touches to the
/// middle.
TEST(NarrowPassage, HoldsWhatIsWiderAsFirmlyAsItsWallIs) {
  for (const double share : {0.5, 0.8, 0.9, 0.95}) {
    const double narrowest_m = share * rod_radius_m, pressed_m = rod_radius_m - narrowest_m;
    const double stiffness_N_m = tolerances::wall_N_m2 * 1e-3;
    const double touches = std::acos(1 - 2 * pressed_m / (tube_radius_m - narrowest_m)) / units::pi;
    const double firmly_N = stiffness_N_m * pressed_m * pressed_m / (touches * half_length_m);
    const Fed fed = feed_through(narrowest_m);
    EXPECT_GE(fed.push_N, std::min(firmly_N, 5.0)) << share;
    if (firmly_N > 5) {
      EXPECT_LT(fed.tip_m, middle_m) << share;
    }
  }
}

TEST(NarrowPassage, LetsThroughWhatIsThinner) {
  for (const double share : {1.05, 1.2}) {
    const Fed fed = feed_through(share * rod_radius_m);
    EXPECT_GE(fed.tip_m, middle_m + 2 * half_length_m) << share;
    EXPECT_LT(fed.push_N, 0.5) << share;
    EXPECT_LT(fed.depth_m, 5e-6) << share;
  }
}

}  // namespace
}  // namespace ostium::core
