/// A short angioplasty by rods, from ahead of the ostium: contrast, an inflation, the wall it opens, and that all of it
/// can be gone on with from a saved state.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/session/coupling/coupling.h"
#include "app/session/coupling/tool_geometry.h"
#include "app/session/model/outcome.h"
#include "app/session/model/penetration.h"
#include "app/session/recorder/event_watch.h"
#include "app/session/run/run.h"
#include "app/session/scene/xray_scene.h"
#include "core/base/units.h"
#include "data/assessment/metrics.h"
#include "data/catalogue/catalogue.h"
#include "data/catalogue/instrument/instrument_reader.h"
#include "tests/app/session/short_treatment.h"
#include "tests/support/allocations.h"

namespace ostium::app {
namespace {

TEST(Treatment, ABalloonOpensTheLesionAndTheWallThatRodsMeet) {
  ScriptedRun run(setup(), vessel());
  const double before = lesion_now(run.model, run.state).stenosis;
  EXPECT_NEAR(before, 0.70, 0.02);
  ASSERT_TRUE(run_to(run, 3)) << reason(run);
  EXPECT_EQ(run.state.coupling.tip.where, vascular::TipPlace::coronary);
  EXPECT_GT(run.state.blood.contrast.from_tip_kg, 0);
  ASSERT_TRUE(run_to(run, 6)) << reason(run);
  ASSERT_TRUE(balloon_from_lesion_m(run.model, run.state));
  EXPECT_NEAR(*balloon_from_lesion_m(run.model, run.state), 0, 6e-3) << "its 12 mm lie over the lesion's middle";
  const double open_flow = supply_behind_lesion(run.model, run.state);
  ASSERT_TRUE(run_to(run, 9)) << reason(run);
  EXPECT_GT(run.state.treatment.balloons[0].pressure_Pa, 3 * 101325.0);
  EXPECT_GT(balloon_artery_ratio(run.model, run.state), 0.6);
  EXPECT_LT(supply_behind_lesion(run.model, run.state), open_flow);
  EXPECT_TRUE(run.state.treatment.balloons[0].held) << "the wall holds it";

  // A state from here goes on to the bit with a fresh scratch: the opened wall is made anew of it.
  SessionState other = run.state;
  SessionScratch fresh(run.model);
  SessionReport report;
  for (int n = 0; n < 40; ++n) {
    ASSERT_TRUE(run.tick());
    step(run.model, run.inputs, other, fresh, report);
    ASSERT_EQ(first_difference(run.model, run.state, other), "") << n;
  }

  const long before_steps = allocations();
  for (int n = 0; n < 40; ++n) step(run.model, run.inputs, other, fresh, report);
  EXPECT_EQ(allocations() - before_steps, 0);

  // Deflated, then a second device cannot enter beside it, and the run says so.
  EXPECT_FALSE(run_to(run, 11));
  EXPECT_EQ(run.outcome, Outcome::failure);
  EXPECT_NE(reason(run).find("balloon is still in the body"), std::string::npos) << reason(run);
  const std::string tips = where_tips_lie(run.model, run.state, run.report);
  const std::size_t wire = tips.find("wire ");
  ASSERT_NE(wire, std::string::npos) << tips;
  EXPECT_NEAR(std::stod(tips.substr(wire + 5)), 80, 4) << tips;
  EXPECT_TRUE(tips.ends_with(" mm into RCA")) << tips;
  const double after = lesion_now(run.model, run.state).stenosis;
  EXPECT_LT(after, 0.5);
  EXPECT_GT(after, 0.05) << "it recoils";

  const vascular::PhysiologyState& blood = run.state.blood;
  EXPECT_NEAR(accounted_kg(blood.contrast), blood.contrast.injected_kg, 1e-6 * blood.contrast.injected_kg);
  const Plan& plan = run.model.vessel->coronaries->lesions[0];
  int narrowest = plan.path.cells[static_cast<std::size_t>(plan.path.at((plan.from_m + plan.to_m) / 2).index)];
  EXPECT_NEAR(run.state.wall_m[static_cast<std::size_t>(narrowest)],
              blood.radius_m[static_cast<std::size_t>(narrowest)], 2 * wall_follows_m);
  EXPECT_GT(run.state.wall_m[static_cast<std::size_t>(narrowest)],
            1.3 * run.model.physiology.flow.tree.cells[static_cast<std::size_t>(narrowest)].diseased_m);
  const Penetration depth = penetration(run.model, run.state);
  EXPECT_LT(depth.deepest_m, 0.1e-3);
  EXPECT_EQ(depth.outside, 0);
  EXPECT_LE(run.troubled, 3) << trouble_words(run.troubles);
  fluoro::Scene scene;
  add_treatment(run.model, run.state, scene);
  EXPECT_NO_THROW(check(scene));
}

/// A guide in the ostium, a wire far down the artery, a stent still on its balloon beyond the guide's tip.
struct StentAhead {
  ScriptedRun run;
  SessionScratch scratch;
  SessionReport report;
  SessionInputs inputs;
  static constexpr int guide = 0, stent = 2;

  static RunSetup stent_setup() {
    RunSetup out = setup();
    std::string script = predilatation;
    const std::string from = R"({ "do": "advance", "tool": "balloon", "speed_mm_s": 30)";
    script =
        script.substr(0, script.find(from)) +
        R"({ "do": "advance", "tool": "stent", "speed_mm_s": 40, "until": [{ "balloon_at_mm": -15 }], "timeout_s": 6 },
                { "do": "mark", "text": "there" } ] })";
    set_script(data::read_script("predilatation.json", script), out);
    return out;
  }
  StentAhead() : run(stent_setup(), vessel()), scratch(run.model) {
    while (run.tick()) {
    }
    EXPECT_EQ(run.outcome, Outcome::success) << reason(run);
    inputs = run.inputs;
    for (ToolInputs& tool : inputs.tools) tool = {};
  }
  vascular::StentState& crimped() { return run.state.treatment.stents[0]; }
  /// How far its proximal end is in the guide.
  double inside_m() {
    const auto inserted = [&](int tool) { return run.state.rods.rods[static_cast<std::size_t>(tool)].inserted_m; };
    return marker_from_tip_m(run.model.tools[stent].instrument, 0) - crimped().shift_m -
           (inserted(stent) - inserted(guide));
  }
  template <class Until>
  void move(int tool, double mm_s, double seconds, Until&& until) {
    inputs.tools[static_cast<std::size_t>(tool)].feed_m_s = 1e-3 * mm_s;
    for (int n = 0; n < 1000 * seconds && !until(); ++n) step(run.model, inputs, run.state, scratch, report);
    inputs.tools[static_cast<std::size_t>(tool)] = {};
  }
};

TEST(Treatment, AStentThatHangsOnTheGuidesEdgeIsLostIfPulledHard) {
  StentAhead s;
  CouplingState& coupling = s.run.state.coupling;
  EXPECT_EQ(coupling.balloons[0].stent_out, 1);
  ASSERT_LT(s.inside_m(), 0);
  // It hangs; a gentle pull, and it comes free when it is pushed on.
  s.move(s.stent, -20, 5, [&] { return s.inside_m() > 0.2e-3; });
  coupling.balloons[0].caught = true;
  s.move(s.stent, -20, 0.08, [] { return false; });
  EXPECT_EQ(coupling.balloons[0].caught, 1);
  EXPECT_GT(coupling.balloons[0].caught_N, 0.3);
  EXPECT_EQ(s.crimped().shift_m, 0);
  s.move(s.stent, 20, 1, [&] { return !coupling.balloons[0].caught; });
  EXPECT_EQ(coupling.balloons[0].caught, 0);
  // Hard.
  s.move(s.stent, -20, 5, [&] { return s.inside_m() > 0.2e-3; });
  coupling.balloons[0].caught = true;
  double pull_N = 0;
  s.move(s.stent, -20, 4, [&] {
    if (!s.report.tools.empty()) pull_N = std::min(pull_N, s.report.tools[s.stent].push_N);
    return s.crimped().where == vascular::StentState::lost;
  });
  EXPECT_EQ(s.crimped().where, vascular::StentState::lost);
  EXPECT_LT(pull_N, -1.0) << "the hand has felt it";
  s.move(s.stent, 0, 0.02, [] { return false; });
  EXPECT_EQ(coupling.balloons[0].caught_N, 0);
}

TEST(Treatment, AGuideThatGoesDeepDeformsAStentAndFeelsIt) {
  StentAhead s;
  vascular::StentState& stent = s.crimped();
  // As if it had been left there, hardly opened, right ahead of the guide.
  const Eigen::Vector3d p = tip(s.run.model, s.run.state, s.guide);
  const vascular::VesselPath& path =
      s.run.model.treatment.paths[static_cast<std::size_t>(s.run.state.coupling.balloons[0].branch)];
  double at_m = 0, nearest = 1;
  for (std::size_t k = 0; k < path.cells.size(); ++k) {
    const Eigen::Vector3d c = s.run.model.vessel->coronaries->map.coronary.position(
        static_cast<std::size_t>(path.cells[k]), s.run.state.blood.heart.phase);
    if ((c - p).norm() < nearest) nearest = (c - p).norm(), at_m = path.s_m[k];
  }
  stent.where = vascular::StentState::deployed, stent.branch = s.run.state.coupling.balloons[0].branch;
  stent.middle_m = at_m + 2e-3 + (span_of(stent).second - span_of(stent).first) / 2, stent.shift_m = 0;
  for (auto* radii : {&stent.radius_m, &stent.rest_m}) std::fill(radii->begin(), radii->end(), 1.0e-3);
  const auto [from, to] = span_of(stent);
  double felt_N = 0;
  s.move(s.guide, 10, 0.8, [&] {
    felt_N = std::max(felt_N, s.run.state.coupling.edge_push_N);
    return false;
  });
  EXPECT_GT(felt_N, 0.2);
  EXPECT_GT(span_of(stent).first, from + 0.5e-3);
  EXPECT_LT(span_of(stent).second - span_of(stent).first, to - from - 0.3e-3);
}

TEST(Treatment, ADeviceThatReachesOutOfTheOstiumLiesInTheArtery) {
  StentAhead s;
  const CouplingState& coupling = s.run.state.coupling;
  const double half_m = (marker_from_tip_m(s.run.model.tools[s.stent].instrument, 0) -
                         marker_from_tip_m(s.run.model.tools[s.stent].instrument, 1)) /
                        2;
  s.move(s.guide, -40, 0.6, [] { return false; });
  ASSERT_NE(coupling.tip.where, vascular::TipPlace::coronary);
  // Drawn out until less than half of it is in the artery: its place goes on until then, without a jump.
  double least = 1, was = -1, jump = 0;
  s.move(s.stent, -20, 3, [&] {
    if (coupling.balloons[0].branch < 0) return true;
    if (was >= 0) jump = std::max(jump, std::fabs(coupling.balloons[0].middle_m - was));
    was = coupling.balloons[0].middle_m, least = std::min(least, was);
    return false;
  });
  EXPECT_EQ(coupling.balloons[0].branch, -1);
  EXPECT_LT(least, 0.3 * half_m);
  EXPECT_LT(jump, 2e-3);
}

TEST(Treatment, AnOpenBalloonStaysInItsArtery) {
  ScriptedRun run(setup(), vessel());
  ASSERT_TRUE(run_to(run, 6)) << reason(run);
  const CouplingModel model{*run.model.vessel,    run.model.tools,     run.model.rods,
                            run.model.physiology, run.model.treatment, run.model.balloon_of};
  CouplingScratch scratch(*run.model.vessel);
  const core::StepReport report;
  const int balloon = 1;
  // For a moment its shaft is thrown aside, by less than what is searched for vessels.
  core::State aside = run.state.rods;
  const Eigen::Vector3d sideways = 4.5e-3 * tip_direction(run.model, run.state, balloon).unitOrthogonal();
  for (int i = 0; i <= model.rods.rods[balloon].elements; ++i)
    aside.rods[balloon].position.set(i, run.state.rods.rods[balloon].position[i] + sideways);
  const auto branch_of = [&](vascular::TreatmentState treatment) {
    treatment.balloons[0].held = false;  // within a stent it meets no wall
    CouplingState coupling = run.state.coupling;
    look(model, aside, treatment, report, {.phase = run.state.blood.heart.phase}, scratch, coupling);
    return coupling.balloons[0].branch;
  };
  const double artery = run.state.coupling.balloons[0].branch;
  ASSERT_GE(artery, 0);
  EXPECT_NE(branch_of(run.state.treatment), artery) << "folded, it may be anywhere";
  vascular::TreatmentState open = run.state.treatment;
  for (double& r : open.balloons[0].radius_m) r = 1.2e-3;
  EXPECT_EQ(branch_of(open), artery);
}

TEST(Treatment, AWallFeelsAWiresTipBehindALowPass) {
  ScriptedRun run(setup(), vessel());
  const CouplingModel coupling{*run.model.vessel,    run.model.tools,     run.model.rods,
                               run.model.physiology, run.model.treatment, run.model.balloon_of};
  CouplingState& s = run.state.coupling;
  const int wire = 3, tip = run.model.rods.rods[wire].elements;
  const double dt = run.model.step_s(), share = 1 - std::exp(-2 * units::pi * data::wall_force_cut_off_Hz * dt);
  core::StepReport report;
  const Eigen::Vector3d none = Eigen::Vector3d::Zero();
  report.touches.assign(1, {.rod = wire, .node = tip, .p_W = none, .normal_W_N = none, .friction_W_N = none});
  const auto press = [&](double N, int steps) {
    report.touches[0].normal_W_N = {0, N, 0};
    for (int n = 0; n < steps; ++n) press_with_wire(coupling, report, dt, s);
  };
  press(10, 1);
  EXPECT_EQ(s.wire_tip_N, 0) << "it lies in no coronary artery";
  s.wire_cell = 5;
  press(10, 1);
  EXPECT_NEAR(s.wire_tip_N, 10 * share, 1e-12);
  press(0.05, 500);
  EXPECT_NEAR(s.wire_tip_N, 0.05, 1e-6);
  report.touches[0].friction_W_N = {0, 0, 0.12};
  press(0.05, 500);
  EXPECT_NEAR(s.wire_tip_N, 0.13, 1e-6) << "what the wire behind gives";
  report.touches.push_back(report.touches[0]);
  report.touches[1].node = tip - 1, report.touches[1].normal_W_N = {0, -0.05, 0};
  report.touches[1].friction_W_N = {0, 0, -0.12};
  press(0.05, 500);
  EXPECT_NEAR(s.wire_tip_N, 0, 1e-6) << "wedged between opposite walls";
  report.touches.resize(1);
  report.touches[0].node = tip - 10;  // 1 cm from the tip
  press(0.05, 500);
  EXPECT_EQ(s.wire_tip_N, 0);
}

TEST(Treatment, ALesionIsCoveredWithMargins) {
  StentAhead s;
  const SessionModel& model = s.run.model;
  const Plan& plan = model.vessel->coronaries->lesions[0];
  vascular::StentState& stent = s.crimped();
  EventWatch watch(model);
  std::vector<SessionEvent> events;
  events.reserve(1000);
  s.move(s.guide, 0, 0.01, [] { return false; });
  const auto last = [&](vascular::StentState::Where where, int branch, double middle_m) {
    stent.where = vascular::StentState::on_balloon;
    watch.look(model, s.inputs, s.run.state, s.report, {}, events);
    stent.where = where, stent.branch = branch, stent.middle_m = middle_m, stent.shift_m = 0;
    watch.look(model, s.inputs, s.run.state, s.report, {}, events);
    return events.back();
  };
  const int own = model.physiology.flow.tree.branch("RCA");
  const double middle = (plan.from_m + plan.to_m) / 2;
  EXPECT_FALSE(lesion_is_covered(model, s.run.state, 0)) << "it is on its balloon";
  // 15 mm on a lesion of 9 mm: 3 mm on either side.
  SessionEvent e = last(vascular::StentState::deployed, own, middle);
  EXPECT_EQ(e.code, static_cast<int>(data::EventCode::stent_deployed));
  EXPECT_NEAR(e.value, 0, 0.3);
  EXPECT_TRUE(lesion_is_covered(model, s.run.state, 2e-3));
  EXPECT_FALSE(lesion_is_covered(model, s.run.state, 4e-3));
  e = last(vascular::StentState::deployed, own, middle + 2e-3);
  EXPECT_NEAR(e.value, 2, 0.3);
  EXPECT_FALSE(lesion_is_covered(model, s.run.state, 2e-3));
  // Elsewhere, and nowhere.
  const int conus = model.physiology.flow.tree.branch("Conus");
  e = last(vascular::StentState::deployed, conus,
           model.treatment.paths[static_cast<std::size_t>(conus)].length_m() - 10e-3);
  EXPECT_EQ(e.code, static_cast<int>(data::EventCode::stent_elsewhere));
  EXPECT_EQ(model.vessel->way->branches()[static_cast<std::size_t>(e.value)].name, "Conus");
  EXPECT_FALSE(lesion_is_covered(model, s.run.state, 0));
  e = last(vascular::StentState::deployed, -1, 0);
  EXPECT_EQ(e.code, static_cast<int>(data::EventCode::stent_lost));
  EXPECT_EQ(e.value, 0);
}

TEST(Treatment, AWithdrawalIsNotDoneBeforeItsHandHasMoved) {
  RunSetup own;
  set_vessel("rca-mid-focal", vascular::LengthUnit::millimetre, own);
  std::string script = predilatation;
  const std::size_t steps = script.find("\"steps\"");
  script.replace(
      steps, std::string::npos,
      R"("steps": [ { "do": "withdraw", "tool": "balloon", "speed_mm_s": 1, "until": [{ "balloon_at_mm": 0 }] } ] })");
  set_script(data::read_script("predilatation.json", script), own);
  ScriptedRun run(own, vessel());
  const Plan& plan = vessel()->coronaries->lesions[0];
  const double middle = (plan.from_m + plan.to_m) / 2;
  run.state.coupling.balloons[0].tool = 1, run.state.coupling.balloons[0].balloon = 0;
  run.state.coupling.balloons[0].branch = run.model.physiology.flow.tree.branch("RCA");
  run.state.blood.heart.phase = 0.75;
  SessionReport report;
  report.tools.resize(run.model.tools.size());
  std::vector<OperatorEvent> events;
  const auto outcome = [&](double beyond_m) {
    run.state.treatment.balloons[0].seat_m = middle + beyond_m;
    return decide(run.plan, run.model, run.state, report, run.hands, run.inputs, events);
  };
  for (int i = 0; i < 3; ++i) EXPECT_EQ(outcome(10e-3), Outcome::running) << "it lies beyond, and the hand is late";
  EXPECT_EQ(outcome(-0.1e-3), Outcome::success);
}

TEST(Treatment, AFoldedBalloonIsAsThickAsItsShaftShows) {
  vascular::TreatmentModel model;
  std::vector<SessionTool> tools;
  for (const char* name : {"balloon-15x10", "balloon-20x10", "balloon-nc-30x12", "stent-30x18"})
    tools.push_back({name, data::load_instrument(data::data_folder() + "/instruments/" + name + ".json"), ""});
  add_devices(tools, 1, model);
  ASSERT_EQ(model.balloons.size(), 4u);
  const double profile_m[] = {0.65e-3, 0.75e-3, 1.0e-3};  // printed by makers; a wider one sticks in a tight lesion
  for (std::size_t i = 0; i < 3; ++i) {
    const vascular::BalloonModel& balloon = model.balloons[i];
    EXPECT_NEAR(2 * balloon.folded_m, profile_m[i], 1e-9) << balloon.name;
    EXPECT_GT(balloon.refolded_m, balloon.folded_m) << balloon.name;
    const vascular::BalloonState state = make_balloon_state(balloon);
    EXPECT_NEAR(2 * *std::max_element(state.radius_m.begin(), state.radius_m.end()), profile_m[i], 1e-9);
    EXPECT_TRUE(is_empty(balloon, state)) << balloon.name;
  }
  // Not that of the stent that is crimped on it.
  EXPECT_LT(2 * model.balloons[3].folded_m, 0.99e-3);
}

TEST(Treatment, APerforationHarmsAndATearThatNoStentCovers) {
  StentAhead s;
  const SessionModel& model = s.run.model;
  const Plan& plan = model.vessel->coronaries->lesions[0];
  vascular::StentState& stent = s.crimped();
  vascular::Injury& injury = s.run.state.treatment.injury.injuries[0];
  EXPECT_TRUE(is_unharmed(model, s.run.state));
  const int cell = plan.path.cells[static_cast<std::size_t>(plan.path.at((plan.from_m + plan.to_m) / 2).index)];
  injury = {.kind = vascular::InjuryKind::dissection, .cell = cell, .grade = 1};
  EXPECT_TRUE(is_unharmed(model, s.run.state)) << "type B";
  injury.grade = 2;
  EXPECT_FALSE(is_unharmed(model, s.run.state)) << "type C";
  stent.where = vascular::StentState::deployed, stent.branch = model.physiology.flow.tree.branch("RCA");
  stent.middle_m = (plan.from_m + plan.to_m) / 2, stent.shift_m = 0;
  EXPECT_TRUE(is_unharmed(model, s.run.state)) << "it is tacked up";
  stent.middle_m += 40e-3;
  EXPECT_FALSE(is_unharmed(model, s.run.state));
  injury = {.kind = vascular::InjuryKind::perforation, .cell = cell, .grade = 1};
  stent.middle_m -= 40e-3;
  EXPECT_FALSE(is_unharmed(model, s.run.state));
}

}  // namespace
}  // namespace ostium::app
