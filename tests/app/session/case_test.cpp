/// A case in a session: places of the vessel index, cardiac timing, closed contrast bodies, shafts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "app/session/live/emergency.h"
#include "app/session/live/live_driver.h"
#include "app/session/run/play.h"
#include "app/session/run/replay.h"
#include "app/session/run/run.h"
#include "app/session/scene/film.h"
#include "app/session/scene/xray_scene.h"
#include "core/base/units.h"
#include "vascular/motion/heart_cycle.h"

namespace ostium::app {
namespace {

RunSetup case_setup() {
  RunSetup setup;
  set_vessel("rca-mid-focal", vascular::LengthUnit::millimetre, setup);
  set_script(data::find_script("iliac-wire"), setup);
  return setup;
}

std::shared_ptr<const Vessel> case_vessel() {
  static const std::shared_ptr<const Vessel> made = [] {
    std::string warnings;
    return make_vessel(case_setup(), warnings);
  }();
  return made;
}

TEST(CaseVessel, PlacesLieInTheOrderOfTheWayFromTheGroin) {
  const VesselIndex& way = *case_vessel()->way;
  double before_m = 0;
  for (const char* name : {"right iliac", "aorta", "diaphragm", "arch", "ascending aorta", "sinuses", "valve"}) {
    const int place = way.place(name);
    ASSERT_GE(place, 0) << name;
    EXPECT_GE(way.from_access_m(place), before_m) << name;
    before_m = way.from_access_m(place);
  }
  EXPECT_NEAR(before_m, 0.75, 0.1) << "groin to valve";
  const int sinuses = way.place("ascending aorta");
  for (const char* name : {"RCA", "RCA+20", "LM", "LAD", "LCx+10"}) {
    ASSERT_GE(way.place(name), 0) << name;
    EXPECT_TRUE(way.beyond(way.place(name), sinuses)) << name;
  }
  EXPECT_TRUE(way.beyond(way.place("LAD"), way.place("LM")));
  EXPECT_FALSE(way.beyond(way.place("left subclavian"), sinuses));
  EXPECT_NEAR(way.from_access_m(way.place("RCA+20")) - way.from_access_m(way.place("RCA")), 0.02, 1.5e-3);
  const vascular::TreeBranch& D1 = way.branches()[static_cast<std::size_t>(way.branch(way.place("D1")))];
  const vascular::TreeBranch& LAD = way.branches()[static_cast<std::size_t>(D1.parent)];
  ASSERT_EQ(LAD.name, "LAD");
  const int before = way.place("D1-4");
  EXPECT_EQ(way.branch(before), way.branch(way.place("LAD")));
  EXPECT_NEAR((way.p(before, 0) - LAD.spheres[D1.parent_sphere].p).norm(), 4e-3, 1.5e-3);
  EXPECT_EQ(way.branch(way.place("LAD-3")), way.branch(way.place("LM")));
  for (const char* none : {"right iliac-4", "D1-", "D1--4", "D1+-4", "-4"}) EXPECT_EQ(way.place(none), -1) << none;
}

TEST(CaseVessel, TheHeartKeepsItsTime) {
  RunSetup setup = case_setup();
  set_value("heart_rate", "90", setup);
  ScriptedRun run(setup, case_vessel());
  double previous = 0;
  std::uint64_t last_beat = 0;
  while (run.state.rods.step < 900 && run.tick()) {
    const double rate = run.state.blood.heart.circulation.rate_1_min;  // as asked for, and what the baroreflex adds
    EXPECT_NEAR(rate, 90, 2);
    EXPECT_NEAR(std::fmod(run.state.blood.heart.phase - previous + 1, 1), 1e-3 * vascular::phase_speed(previous, rate),
                1e-6);
    if (run.state.blood.heart.phase < previous) last_beat = run.state.rods.step;
    previous = run.state.blood.heart.phase;
  }
  EXPECT_NEAR(static_cast<double>(last_beat), 1000 * 60 / 90.0, 3) << "explicit steps of a smooth speed";
  EXPECT_EQ(run.state.blood.heart.beats, 1);
}

TEST(CaseVessel, ContrastFillsOneCoronaryTreeAndIsClosed) {
  for (Fill fill : {Fill::left, Fill::right}) {
    const XrayPatient patient(case_vessel()->patient, fill);
    for (double phase : {0.0, 0.4}) {
      const fluoro::Scene scene = patient.at(phase);
      ASSERT_NO_THROW(check(scene));
      const auto found = std::find_if(scene.moving.begin(), scene.moving.end(),
                                      [](const fluoro::Body& body) { return body.name == "contrast"; });
      ASSERT_NE(found, scene.moving.end());
      const fluoro::Body& contrast = *found;
      double volume_mL = 0;
      Eigen::Vector3d middle = Eigen::Vector3d::Zero();
      for (Eigen::Index t = 0; t < contrast.triangles->cols(); ++t) {
        const auto corner = [&](int k) -> Eigen::Vector3d {
          return contrast.p_P.col((*contrast.triangles)(k, t)).cast<double>();
        };
        volume_mL += 1e6 * corner(0).dot(corner(1).cross(corner(2))) / 6;
      }
      for (Eigen::Index v = 0; v < contrast.p_P.cols(); ++v)
        middle += contrast.p_P.col(v).cast<double>() / static_cast<double>(contrast.p_P.cols());
      EXPECT_GT(volume_mL, 0.8);  // some 120 mm of RCA of 3 mm are 0.85 mL, the left tree has twice that
      EXPECT_LT(volume_mL, 5);
      // The heart shifts by 4 mm to the left in systole.
      EXPECT_GT(fill == Fill::left ? middle.x() : -middle.x(), -0.009);
    }
  }
}

/// As after a stent: pixels of 0.6 mm, a lesion some 12 mm long that is 2 mm wider.
TEST(CaseVessel, AFilledArteryIsAsWideAsItIsNow) {
  ScriptedRun run(case_setup(), case_vessel());
  run.tick();
  FilmOptions options;
  options.pixels = 256, options.overlay = false, options.fill = Fill::right;
  const auto picture = [&] {
    Film film(run.model, options);
    return film.frame(run.model, run.state, run.inputs).grey;
  };
  const auto narrow = picture();
  const vascular::FlowTree& tree = run.model.vessel->coronaries->tree();
  for (std::size_t c = 0; c < tree.cells.size(); ++c) run.state.blood.radius_m[c] = tree.cells[c].healthy_m;
  const auto wide = picture();
  long darker = 0, lighter = 0;
  for (std::size_t i = 0; i < wide.size(); ++i) {
    darker += wide[i] + 8 < narrow[i];
    lighter += narrow[i] + 8 < wide[i];
  }
  EXPECT_GT(darker, 15);
  EXPECT_LT(lighter, darker / 4);
}

TEST(CaseVessel, ShaftsHaveTheSteelThatTheCatalogueSays) {
  ScriptedRun run(case_setup(), case_vessel());
  EXPECT_TRUE(shafts_of(run.model, run.state).empty()) << "nothing is in the body yet";
  while (run.state.rods.step < 800 && run.tick()) {
  }
  const std::vector<fluoro::Shaft> shafts = shafts_of(run.model, run.state);
  ASSERT_EQ(shafts.size(), 1u);
  EXPECT_EQ(Eigen::Vector3d(shafts[0].p_P.col(0)), tip(run.model, run.state, 0));
  double length = 0;
  for (Eigen::Index i = 1; i < shafts[0].p_P.cols(); ++i)
    length += (shafts[0].p_P.col(i) - shafts[0].p_P.col(i - 1)).norm();
  EXPECT_NEAR(length, run.state.rods.rods[0].inserted_m, 1e-6);
  const data::Instrument& wire = run.model.tools[0].instrument;
  ASSERT_EQ(shafts[0].sections.size(), wire.opaque.size());
  for (std::size_t s = 0; s < wire.opaque.size(); ++s) {
    const fluoro::OpaqueSection& o = shafts[0].sections[s];
    const double area =
        o.filling * units::pi * (o.outer_radius_m * o.outer_radius_m - o.inner_radius_m * o.inner_radius_m);
    EXPECT_NEAR(area, wire.opaque[s].thickness_m * wire.outer_diameter_m, 1e-12);
    EXPECT_LE(o.outer_radius_m, 0.5 * wire.outer_diameter_m);
  }
}

TEST(CaseVessel, AProvocationThatThePatientCannotHaveIsRefusedWithTheReason) {
  const ScriptedRun run(case_setup(), case_vessel());
  const auto why = [&](ConsoleCommand command, std::array<double, 4> values) {
    return why_not(run.model, {command, values});
  };
  const int rca = case_vessel()->coronaries->tree().branch("RCA");
  ASSERT_GE(rca, 0);
  const double artery = rca;
  EXPECT_EQ(why(ConsoleCommand::provoke, {1, artery, 40, 0.8}), "");
  EXPECT_EQ(why(ConsoleCommand::provoke, {5, 0, 0, 0}), "") << "a rhythm has no place";
  EXPECT_NE(why(ConsoleCommand::provoke, {1, artery, 40, 4}).find("0.1 to 3 (hole, mm)"), std::string::npos);
  EXPECT_NE(why(ConsoleCommand::provoke, {1, artery, 390, 0.8}).find("RCA has no place 390 mm; expected"),
            std::string::npos);
  EXPECT_NE(why(ConsoleCommand::provoke, {3, 999, 40, 0.5}).find("there is no artery 999"), std::string::npos);
  EXPECT_NE(why(ConsoleCommand::give, {99, 1, 0, 0}).find("protamine"), std::string::npos) << "says what there is";
  const auto& drugs = run.model.treatment.drugs.others;
  for (std::size_t d = 0; d < drugs.size(); ++d) {
    const double drug = static_cast<double>(d);
    EXPECT_EQ(why(ConsoleCommand::give, {drug, drugs[d].most, 0, 0}), "");
    EXPECT_NE(why(ConsoleCommand::give, {drug, 2 * drugs[d].most, 0, 0}).find(drugs[d].name), std::string::npos);
  }
}

/// A trainer's hole bleeds, what answers it is done, all of it is a recorded input, and replays to the bit.
TEST(CaseVessel, WhatIsProvokedAndGivenAtAConsoleReplays) {
  const std::string file =
      (std::filesystem::temp_directory_path() / ("ostium-provoked-" + std::to_string(getpid()) + ".h5")).string();
  ScriptedRun run(case_setup(), case_vessel());
  LiveDriver hand(run.model, Hands::script, 15);
  run.take_over(&hand);
  Controls& trainer = hand.controls(Seat::browser);
  const double rca = case_vessel()->coronaries->tree().branch("RCA");
  std::size_t phenylephrine = 0;
  while (run.model.treatment.drugs.others[phenylephrine].name != "phenylephrine") ++phenylephrine;
  trainer.order({ConsoleCommand::provoke, {1, rca, 40, 1.5}});
  trainer.order({ConsoleCommand::provoke, {3, rca, 20, 0.5}});
  trainer.order({ConsoleCommand::provoke, {7, rca, 10, 5}});
  trainer.order({ConsoleCommand::provoke, {8, 0, 0, 0.5}});
  trainer.order({ConsoleCommand::give, {static_cast<double>(phenylephrine), 100}});
  trainer.order({ConsoleCommand::infuse, {120}});
  trainer.order({ConsoleCommand::drain, {60}});
  trainer.order({ConsoleCommand::compress, {110}});
  trainer.order({ConsoleCommand::pace, {80, 3}});
  std::vector<SessionEvent> heard;
  PlayOptions options;
  options.recorder.file = file, options.recorder.penetration = false, options.seconds = 0.9;
  options.recorder.heard = [&](const SessionEvent& event) { heard.push_back(event); };
  play(run, case_setup(), options);
  const auto of = [&](data::EventCode code) {
    return std::count_if(heard.begin(), heard.end(),
                         [&](const SessionEvent& e) { return e.code == static_cast<int>(code); });
  };
  EXPECT_EQ(of(data::EventCode::provoked), 4);
  EXPECT_EQ(of(data::EventCode::thrombus_forms), 1);
  EXPECT_EQ(of(data::EventCode::drug_given), 1);
  EXPECT_EQ(of(data::EventCode::infusion_begins), 1);
  EXPECT_EQ(of(data::EventCode::drain_begins), 1);
  EXPECT_EQ(of(data::EventCode::compressions_begin), 1);
  EXPECT_EQ(of(data::EventCode::pacing_captures), 1);
  for (const SessionEvent& e : heard) {
    if (e.code == static_cast<int>(data::EventCode::provoked)) {
      EXPECT_LE(e.step, 50u) << "ms from order to event";
    }
  }
  EXPECT_GT(vascular::leak_m3_s(run.state.treatment), 0.5e-6) << "a hole of 1.5 mm";
  EXPECT_NEAR(volume_m3(run.state.treatment.thrombus), 5e-9, 0.1e-9);
  EXPECT_NEAR(run.state.blood.air.line_m3, 0.5e-6, 1e-12);
  EXPECT_NEAR(run.inputs.delivery.infusion_m3_s, 2e-6, 1e-12);
  EXPECT_NEAR(run.inputs.delivery.drain_m3_s, 1e-6, 1e-12);
  EXPECT_EQ(run.inputs.delivery.compressions_1_min, 110);
  EXPECT_EQ(run.inputs.delivery.pacing_mA, 3);
  Replay replay(file, case_vessel());
  const VerifyReport report = verify(replay);
  EXPECT_FALSE(report.first_step) << report.field;
  EXPECT_EQ(report.steps, 900u);
  std::filesystem::remove(file);
}

/// After going back, what a script gives ends when the script ends it; what a console gave goes on.
TEST(CaseVessel, GoingBackLeavesAScriptWhatIsItsOwn) {
  const ScriptedRun run(case_setup(), case_vessel());
  Emergency console;
  const DeliveryInputs was{.infusion_m3_s = 2e-6, .compressions_1_min = 110, .pacing_1_min = 80, .pacing_mA = 5};
  const DeliveryInputs of_script{.compressions_1_min = 110, .pacing_1_min = 80, .pacing_mA = 5};
  console.restart(was);
  DeliveryInputs to = of_script;
  console.fill(run.model, to);
  EXPECT_EQ(to.infusion_m3_s, 2e-6);
  EXPECT_EQ(to.compressions_1_min, 110);
  to = {.pacing_1_min = 80, .pacing_mA = 1.4};
  console.fill(run.model, to);
  EXPECT_EQ(to.infusion_m3_s, 2e-6);
  EXPECT_EQ(to.compressions_1_min, 0);
  EXPECT_EQ(to.pacing_mA, 1.4);
  console.restart(was);
  console.take(run.model, {data::ConsoleCommand::infuse, {0}});
  to = of_script;
  console.fill(run.model, to);
  EXPECT_EQ(to.infusion_m3_s, 0) << "an order before time goes on";
}

RunSetup fluids(const std::string& steps) {
  RunSetup setup = case_setup();
  set_script(data::read_script("fluids.json", R"({ "schema": "ostium-script/1", "name": "fluids", "title": "A test",
    "tools": [ { "name": "guide", "instrument": "guide-jr4-6f" } ], "steps": [ )" +
                                                  steps + " ] }"),
             setup);
  return setup;
}

/// A trainer's infusion.
struct Bag : Driver {
  Driven drive(const ScriptedRun&, SessionInputs& inputs) override {
    inputs.delivery.infusion_m3_s = std::max(inputs.delivery.infusion_m3_s, 4e-6);
    return Driven::on;
  }
};

TEST(CaseVessel, AnActionEndsByWhatItMovedItselfWhateverElseRuns) {
  Bag bag;
  ScriptedRun run(fluids(R"({ "do": "advance", "tool": "guide", "speed_mm_s": 200, "until": [{ "inserted_mm": 20 }] },
    { "do": "aspirate", "rate_mL_s": 4, "volume_mL": 2, "timeout_s": 1 },
    { "do": "infuse", "rate_mL_s": 1, "volume_mL": 1, "timeout_s": 0.5 })"),
                  case_vessel(), &bag);
  while (run.tick()) {
  }
  EXPECT_EQ(run.outcome, Outcome::success) << reason(run);
  EXPECT_NEAR(run.state.blood.heart.circulation.drawn_m3, 2e-6, 0.1e-6);
}

TEST(CaseVessel, AStepThatTimesOutSaysWhatItWaitedForAndSaw) {
  const auto why = [](const std::string& steps) {
    ScriptedRun run(fluids(steps), case_vessel());
    while (run.tick()) {
    }
    return reason(run);
  };
  EXPECT_EQ(
      why(R"({ "do": "aspirate", "rate_mL_s": 4, "volume_mL": 2, "timeout_s": 0.1 })"),
      "step 1 of 1, aspirate: timed out after 0.1 s, waiting for volume_mL 2 (now 0); no catheter is in the body");
  EXPECT_EQ(why(R"({ "do": "infuse", "rate_mL_s": 4, "volume_mL": 2, "timeout_s": 0.1 })"),
            "step 1 of 1, infuse: timed out after 0.1 s, waiting for volume_mL 2 (now 0.4)");
  EXPECT_EQ(why(R"({ "do": "wait", "timeout_s": 0.1, "until": [{ "seconds": 0.2 }, { "tip_passes": "arch", "of":
                    "guide" }, { "engaged": "RCA" }, { "balloon_at_mm": 0 }, { "contrast_in": "RCA+20" }] })"),
            "step 1 of 1, wait: timed out after 0.1 s, waiting for seconds 0.2 (now 0.1) or tip_passes arch of guide "
            "(guide is out of the body) or engaged RCA (no catheter is in the body) or balloon_at_mm 0 (no balloon is "
            "in the body) or contrast_in RCA+20 (the beam is off)");
}

TEST(CaseVessel, WhatTheToolsOrTheVesselRuleOutIsRefused) {
  const auto refusal = [](const std::string& steps, const std::string& from, const std::string& to) {
    RunSetup setup = fluids(steps);
    std::string text = setup.script.source;
    text.replace(text.find(from), from.size(), to);
    try {
      set_script(data::read_script("fluids.json", text), setup);
      ScriptedRun run(setup, case_vessel());
    } catch (const data::LoadError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  const std::string air = R"({ "do": "provoke", "complication": "air" })";
  EXPECT_EQ(refusal(air, "A test", "A test"), "accepted");
  EXPECT_EQ(refusal(air, "guide-jr4-6f", "cook-j"),
            "fluids.json:2: provoke: no tool is a catheter for it; expected one among the tools");
  const auto landmark = [](const std::string& name) {
    return R"("landmarks": [ { "name": ")" + name + R"(", "at_mm": [0, 0, 0] } ], "steps")";
  };
  EXPECT_EQ(refusal(air, "\"steps\"", landmark("mine")), "accepted");
  EXPECT_EQ(refusal(air, "\"steps\"", landmark("RCA")),
            "fluids.json:2: there is a place \"RCA\" in this vessel; expected another name for the landmark");
}

}  // namespace
}  // namespace ostium::app
