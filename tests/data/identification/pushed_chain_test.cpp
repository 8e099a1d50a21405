/// Insertion sets against an independent incremental energy minimiser (tests/support/pushed_chain.h).
#include "tests/support/pushed_chain.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/base/units.h"
#include "core/samples/tube.h"
#include "data/identification/effects/effect_list.h"
#include "data/identification/forward/curve.h"
#include "data/identification/forward/insertion.h"
#include "tests/support/sets/undeclared_tube.h"

namespace ostium::data {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

using units::mm, units::Nmm2;

/// A wire with a soft curved tip, pushed 170 mm into a bent tube and drawn back, all in one plane.
struct Pushed {
  pushed_chain::Tube tube{0.06, 0.05, 1.4, 4e-3};
  pushed_chain::Wire wire{{{0.05, 5 * Nmm2, 0.8e-3, 8}, {1, 30 * Nmm2, 0.8e-3, 0}}, 0.2e-3};
  pushed_chain::Setting setting{0, {0.012, 0}, 9.81, 0.5e-3};
  std::vector<double> inserted{0.08, 0.11, 0.14, 0.17, 0.15, 0.13};

  /// Its declaration, without measurements.
  MeasurementSet set() const {
    MeasurementSet out;
    out.title = "pushed", out.source = "tests";
    out.instruments = {synthetic::declared(wire, "wire", 0.3)};
    out.gravity_m_s2 = {0, 0, -setting.gravity_m_s2};
    Experiment e;
    e.base = synthetic::base_along_x(setting.base_m);
    e.specimen.resize(1);
    for (double length : inserted) {
      e.id = "d" + std::to_string(out.experiments.size());
      e.place = "experiments[" + std::to_string(out.experiments.size()) + "]";
      e.set = {{length, 0, 0}};
      out.experiments.push_back(e);
    }
    const auto points = core::bend(tube.bend_radius_m, tube.angle_rad, tube.lead_m, 0.12, tube.radius_m, 1e-3);
    out.vessel = MeasuredVessel{"tube", "m", setting.friction,
                                std::make_shared<const core::SurfaceDescription>(core::tube(points, 48))};
    return out;
  }
};

Vector3d in_space(const Vector2d& p) { return {p.x(), 0, p.y()}; }

/// The chain itself without contact: a light load on a straight cantilever, w L^4 / 8 EI.
TEST(PushedChain, ACantileverSagsAsBeamTheorySays) {
  const pushed_chain::Tube wide{1, 1, 0, 1};
  const pushed_chain::Wire wire{{{1, 30 * Nmm2, 0.8e-3, 0}}, 0.2e-3};
  const auto rest = pushed_chain::push(wide, wire, {0, {0, 0}, 0.1, 0.25e-3}, {0.1});
  ASSERT_TRUE(rest[0].converged);
  const double sag = 0.8e-3 * 0.1 * 1e-4 / (8 * 30 * Nmm2);
  EXPECT_NEAR(-rest[0].curve.back().y(), sag, 0.01 * sag);
}

/// Root mean square distance of the chains' nodes from the shapes.
double rms_between(const std::vector<pushed_chain::Rest>& chain, const std::vector<PredictedShape>& shapes) {
  double sum = 0, count = 0;
  for (std::size_t e = 0; e < shapes.size(); ++e)
    for (const Vector2d& p : chain[e].curve)
      sum += (nearest_point(shapes[e].points_m, in_space(p)) - in_space(p)).squaredNorm(), ++count;
  return std::sqrt(sum / count);
}

/// Shapes and push, pushed round a bend and drawn back.
TEST(PushedChain, InsertionAgrees) {
  std::vector<double> push_N;
  for (const double friction : {0.0, 0.3}) {
    Pushed pushed;
    pushed.setting.friction = friction;
    const auto chain = pushed_chain::push(pushed.tube, pushed.wire, pushed.setting, pushed.inserted);
    MeasurementSet set = pushed.set();
    const std::vector<PredictedShape> shapes = insert(set, {});
    for (std::size_t e = 0; e < shapes.size(); ++e) {
      ASSERT_TRUE(chain[e].converged && shapes[e].converged) << friction << " " << e;
      for (const Vector2d& p : chain[e].curve)
        EXPECT_LT((nearest_point(shapes[e].points_m, in_space(p)) - in_space(p)).norm(), 0.2 * mm) << friction << e;
      EXPECT_NEAR(shapes[e].base_push_N, chain[e].push_N, 0.15e-3) << friction << " " << e;
    }
    push_N.push_back(chain[3].push_N), push_N.push_back(chain[4].push_N);
    if (friction == 0) continue;
    // Omitting the friction shows: the shapes are then further off.
    set.vessel->friction = 0;
    const double with = rms_between(chain, shapes), without = rms_between(chain, insert(set, {}));
    EXPECT_LT(with, 0.07 * mm);
    EXPECT_GT(without, 3 * with);
  }
  // Friction matters: without it, pushing in and drawing back take 3.7 and 5.8 mN; with it, 10.0 and -1.1 mN.
  EXPECT_GT(push_N[2], 2 * push_N[0]);
  EXPECT_LT(push_N[3], 0);
}

/// A catheter in a tube whose wall yields by more than the catheter's radius; without friction and with.
TEST(PushedChain, InsertionIntoASoftWallAgrees) {
  for (const double friction : {0.0, 0.3}) {
    Pushed pushed;
    pushed.tube = {0.05, 0.045, 1.3, 3e-3};
    pushed.wire = {{{0.045, 150 * Nmm2, 1.4e-3, 5}, {1, 320 * Nmm2, 1.4e-3, 0}}, 0.87e-3};
    pushed.setting.wall_N_m2 = 5e4, pushed.setting.friction = friction;
    pushed.inserted = {0.06, 0.08, 0.1, 0.085, 0.07};
    const auto chain = pushed_chain::push(pushed.tube, pushed.wire, pushed.setting, pushed.inserted);
    const MeasurementSet set = pushed.set();
    Changes changes;
    changes.effects = {active(find_effect("wall_compliance"), set, {}, {"", {}})};
    changes.effects[0].values[0] = 1e-6 * pushed.setting.wall_N_m2;
    const std::vector<PredictedShape> soft = insert(set, changes);
    double most_N = 0;
    for (const auto& rest : chain) most_N = std::max(most_N, std::fabs(rest.push_N));
    for (std::size_t e = 0; e < soft.size(); ++e) {
      ASSERT_TRUE(chain[e].converged && soft[e].converged) << friction << " " << e;
      for (const Vector2d& p : chain[e].curve)
        EXPECT_LT((nearest_point(soft[e].points_m, in_space(p)) - in_space(p)).norm(), 0.13 * mm) << friction << e;
      EXPECT_NEAR(soft[e].base_push_N, chain[e].push_N, 0.08 * most_N) << friction << " " << e;
    }
    EXPECT_LT(rms_between(chain, soft), 0.04 * mm);
    EXPECT_GT(rms_between(chain, insert(set, {})), 0.2 * mm);
  }
}

}  // namespace
}  // namespace ostium::data
