/// Insertion in a vessel: untouched instruments behave as free rods, and touching ones stay inside.
#include "data/identification/forward/insertion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/samples/tube.h"
#include "data/identification/forward/prediction.h"
#include "tests/support/sets/synthetic_set.h"

namespace ostium::data {
namespace {

using Eigen::Vector3d;

/// A wire from the origin along x; `experiments` at increasing insertions.
MeasurementSet wire_in(const core::SurfaceDescription& wall, int experiments, double longest_m) {
  MeasurementSet set = synthetic::free_wire(1);
  Experiment e = set.experiments[0];
  e.base.p_W = {0.012, 0, 0};
  e.tip_force_N.setZero();
  set.experiments.clear();
  for (int i = 0; i < experiments; ++i) {
    e.id = "d" + std::to_string(i), e.place = "experiments[" + std::to_string(i) + "]";
    e.set = {{longest_m * (i + 1) / experiments, 0.3, 0}};
    set.experiments.push_back(e);
  }
  set.vessel = MeasuredVessel{"tube", "m", 0.05, std::make_shared<const core::SurfaceDescription>(wall)};
  return set;
}

/// A wide tube: the wire hangs freely and comes to rest at the static solution.
TEST(Insertion, AWireThatTouchesNothingComesToRestAsAFreeOne) {
  const auto wide = core::tube({{{-0.01, 0, 0}, 0.1}, {{0.1, 0, 0}, 0.1}, {{0.3, 0, 0}, 0.1}}, 24);
  MeasurementSet set = wire_in(wide, 2, 0.16);
  const std::vector<PredictedShape> in_vessel = insert(set, {});
  set.vessel.reset();
  const std::vector<StaticEquilibrium> anchors = walk(set, {});
  for (std::size_t e = 0; e < 2; ++e) {
    ASSERT_TRUE(in_vessel[e].converged);
    const PredictedShape free = shape_from(setup_of(set, set.experiments[e], {}), anchors[e]);
    // Elements here are 2 mm, and a residual motion of up to 0.2 mm/s is left.
    EXPECT_LT((in_vessel[e].points_m.back() - free.points_m.back()).norm(), 0.3e-3) << e;
  }
}

/// A bent tube of 5 mm: the wire follows it and stays inside, and friction increases the push.
TEST(Insertion, AWireStaysInABentTubeAndFrictionCostsPush) {
  const auto points = core::bend(0.05, 1.2, 0.06, 0.1, 2.5e-3, 2e-3);
  const auto wall = core::tube(points, 24);
  MeasurementSet set = wire_in(wall, 2, 0.15);
  for (core::Section& s : set.instruments[0].sections) s.rest_curvature_per_m.setZero();
  std::vector<double> push;
  for (const double friction : {0.02, 0.3}) {
    set.vessel->friction = friction;
    const std::vector<PredictedShape> shapes = insert(set, {});
    ASSERT_TRUE(shapes[1].converged);
    for (const Vector3d& p : shapes[1].points_m) {
      double nearest = 1;
      for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const Vector3d edge = points[i + 1].p_W - points[i].p_W;
        const double t = std::clamp((p - points[i].p_W).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
        nearest = std::min(nearest, (p - points[i].p_W - t * edge).norm());
      }
      EXPECT_LT(nearest, 2.5e-3 - 0.178e-3 + 0.05e-3);
    }
    push.push_back(shapes[1].base_push_N);
  }
  EXPECT_GT(push[1], push[0]);
}

TEST(Insertion, WhatAVesselDoesNotKnowIsRefused) {
  const auto wide = core::tube({{{-0.01, 0, 0}, 0.1}, {{0.3, 0, 0}, 0.1}}, 12);
  MeasurementSet set = wire_in(wide, 2, 0.1);
  set.experiments[1].base.p_W.x() += 1e-3;
  EXPECT_THROW(predict(set), LoadError);
  set.experiments[1].base = set.experiments[0].base;
  set.vessel->wall.reset();
  EXPECT_THROW(predict(set), LoadError);
}

}  // namespace
}  // namespace ostium::data
