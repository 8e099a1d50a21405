/// A balloon on its shaft in a session: it lies on it until the wall takes it to the middle; open, it
/// holds the shaft against the operator's hand.
#include <gtest/gtest.h>

#include <cmath>

#include "app/session/coupling/device_constraints.h"
#include "app/session/coupling/tool_geometry.h"
#include "tests/app/session/short_treatment.h"

namespace ostium::app {
namespace {

constexpr int balloon_tool = 1;

TEST(BalloonOnItsShaft, IsTakenToTheMiddleAndHoldsItsShaft) {
  ScriptedRun run(setup(), vessel());
  ASSERT_TRUE(run_to(run, 6)) << reason(run);
  const vascular::BalloonState& body = run.state.treatment.balloons[0];
  const std::size_t middle = vascular::balloon_spheres / 2;
  const auto aside_mm = [&] { return 1e3 * body.aside_m[middle].norm(); };
  double most_aside_mm = 0, wall_N = 0;
  int counted = 0;
  while (static_cast<int>(run.hands.step) < 8) {
    ASSERT_TRUE(run.tick());
    most_aside_mm = std::max(most_aside_mm, aside_mm());
    if (body.pressure_Pa < 4 * 101325) continue;
    wall_N += run.report.treatment.balloons[0].aside_N;
    ++counted;
  }
  ASSERT_GT(counted, 100);
  EXPECT_GT(most_aside_mm, 0.03) << "as it opens it lies where its shaft lies";
  const double shaft_mm = 1e3 * run.state.coupling.balloons[0].aside_m[middle].norm();
  EXPECT_LT(aside_mm(), 0.1 * 1e3 * body.radius_m[middle]) << "of its radius";
  EXPECT_GT(shaft_mm, 2 * aside_mm()) << "which lies loose inside";
  EXPECT_GT(wall_N, 0.05 * counted);

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
  EXPECT_LT(report.tools[balloon_tool].push_N, -0.3);
  drawn_mm(0, -101325, 10000);
  EXPECT_GT(drawn_mm(10e-3, -101325, 800), 3);
  EXPECT_GT(report.tools[balloon_tool].push_N, -0.3);
}

TEST(BalloonOnItsShaft, WhatBodyAndShaftPullEachOtherWithIsOpposite) {
  // Long, across a bend, through a beat: the middle between its markers is not where the shaft's middle lies.
  RunSetup long_one = setup();
  set_value("balloon", "stent-325x28", long_one);
  ScriptedRun run(long_one, vessel());
  ASSERT_TRUE(run_to(run, 6)) << reason(run);
  const vascular::BalloonState& body = run.state.treatment.balloons[0];
  SessionInputs inputs = run.inputs;
  inputs.tools[balloon_tool] = {}, inputs.delivery.gauge_Pa = 6 * 101325;
  SessionScratch scratch(run.model);
  SessionReport report;
  const CouplingModel coupling{*run.model.vessel,    run.model.tools,     run.model.rods,
                               run.model.physiology, run.model.treatment, run.model.balloon_of};
  int compared = 0;
  double most_mm = 0;
  for (int n = 0; n < 3000; ++n) {
    step(run.model, inputs, run.state, scratch, report);
    if (!body.held) continue;
    const vascular::LumenMoment now = moment(run.model, run.state);
    const core::Tether tether =
        tethers_on_shaft(coupling, run.state.rods, run.state.treatment, run.state.coupling, balloon_tool, now)[0];
    const Eigen::Vector3d p =
        point_from_tip(run.model.rods.rods[balloon_tool], run.state.rods.rods[balloon_tool], tether.from_tip_m);
    const double shaft_ahead_m =
        treatment_inputs(coupling, run.state.rods, run.state.treatment, inputs.delivery, now, run.state.coupling)
            .balloons[0]
            .shaft.middle_m -
        body.seat_m;
    EXPECT_NEAR((tether.point_W - p).dot(tether.along_W), -shaft_ahead_m, 1e-9);
    most_mm = std::max(most_mm, 1e3 * std::fabs(shaft_ahead_m)), ++compared;
  }
  EXPECT_GT(compared, 1000);
  EXPECT_GT(most_mm, 0.1);
}

}  // namespace
}  // namespace ostium::app
