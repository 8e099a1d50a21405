/// A balloon on its shaft in a session: it lies on it until the wall takes it to the middle, and takes its shaft along;
/// open, it holds the shaft against the operator's hand.
#include <gtest/gtest.h>

#include <cmath>

#include "app/session/coupling/device_constraints.h"
#include "app/session/coupling/tool_geometry.h"
#include "tests/app/session/short_treatment.h"

namespace ostium::app {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

constexpr int balloon_tool = 1;

CouplingModel coupling_of(const ScriptedRun& run) {
  return {*run.model.vessel,    run.model.tools,     run.model.rods,
          run.model.physiology, run.model.treatment, run.model.balloon_of};
}

/// What the bonds pull the shaft with, N, across.
Vector3d bonds_N(const ScriptedRun& run) {
  const auto tethers = tethers_on_shaft(coupling_of(run), run.state.treatment, run.state.coupling, balloon_tool,
                                        moment(run.model, run.state));
  Vector3d sum = Vector3d::Zero();
  for (const core::Tether& tether : tethers) {
    const Vector3d off = tether.point_W - point_from_tip(run.model.rods.rods[balloon_tool],
                                                         run.state.rods.rods[balloon_tool], tether.from_tip_m);
    sum += tether.across_N_m * (off - off.dot(tether.along_W) * tether.along_W);
  }
  return sum;
}

TEST(BalloonOnItsShaft, IsTakenToTheMiddleAndHoldsItsShaft) {
  ScriptedRun run(setup(), vessel());
  ASSERT_TRUE(run_to(run, 6)) << reason(run);
  const vascular::BalloonState& body = run.state.treatment.balloon;
  const std::size_t middle = vascular::balloon_spheres / 2;
  const auto aside_mm = [&] { return 1e3 * body.aside_m[middle].norm(); };
  double most_aside_mm = 0, wall_N = 0, shaft_N = 0;
  int counted = 0;
  while (static_cast<int>(run.hands.step) < 8) {
    ASSERT_TRUE(run.tick());
    most_aside_mm = std::max(most_aside_mm, aside_mm());
    if (body.pressure_Pa < 4 * 101325) continue;
    wall_N += run.report.treatment.balloon.aside_N, shaft_N += bonds_N(run).norm();
    ++counted;
  }
  ASSERT_GT(counted, 100);
  EXPECT_GT(most_aside_mm, 0.03) << "as it opens it lies where its shaft lies";
  EXPECT_LT(aside_mm(), 0.1);
  EXPECT_GT((run.state.coupling.aside_m[middle]).norm(), 0.1e-3) << "which lies loose inside";
  EXPECT_GT(wall_N, 0.05 * counted);
  EXPECT_NEAR(shaft_N, wall_N, 0.25 * wall_N) << "what the wall pushes with, the shaft bears";

  // Drawn by 4 mm in 0.4 s it stays, and the hand feels it; emptied, it comes along.
  SessionScratch scratch(run.model);
  SessionReport report;
  const auto drawn_mm = [&](double speed_m_s, double gauge_Pa, int steps) {
    SessionInputs inputs = run.inputs;
    inputs.tools[balloon_tool].feed_m_s = -speed_m_s, inputs.delivery.gauge_Pa = gauge_Pa;
    const double from_m = body.seat_m;
    for (int n = 0; n < steps; ++n) step(run.model, inputs, run.state, scratch, report);
    return 1e3 * (from_m - body.seat_m);
  };
  EXPECT_LT(std::fabs(drawn_mm(10e-3, 16 * 101325, 400)), 0.1);
  EXPECT_LT(report.tools[balloon_tool].push_N, -0.5);
  drawn_mm(0, -101325, 10000);
  EXPECT_GT(drawn_mm(10e-3, -101325, 800), 3);
  EXPECT_GT(report.tools[balloon_tool].push_N, -0.5);
}

}  // namespace
}  // namespace ostium::app
