/// Handling errors: each is detected in scenes made by hand; then a case's own map, and a run.
#include "app/session/handling/handling.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/units.h"
#include "tests/app/session/handled_scene.h"

namespace ostium::app {
namespace {

TEST(Handling, ACatheterFollowsAWireBelowTheRoot) {
  Played p;
  CatheterErrors errors;
  p.scene.catheter = guide;
  p.scene.thick_wire = thick;
  p[thick].inserted_m = 0.5;
  p.play(errors, 1, [&](int) { p.feed(guide, 4e-3); });
  EXPECT_TRUE(p.events.empty()) << "to 10 cm behind the wire's tip";
  // 80 mm bring it to 20 mm behind the tip, 10 mm more to the error, which is reported once however far it goes on.
  p.play(errors, 0.2, [&](int) { p.feed(guide, 4e-3); });
  EXPECT_EQ(p.took(data::EventCode::catheter_without_wire), 0);
  p.play(errors, 0.5, [&](int) { p.feed(guide, 4e-3); });
  EXPECT_EQ(p.took(data::EventCode::catheter_without_wire), 1);
  p[guide].sphere = 2;
  p.play(errors, 10, [&](int) { p.feed(guide, 4e-3); });
  EXPECT_TRUE(p.events.empty()) << "beyond the arch it goes without a wire";
}

TEST(Handling, TwistIsJudgedByHowLongAndHowFast) {
  Played p;
  CatheterErrors errors;
  p.scene.catheter = guide;
  p[guide].sphere = 2;
  const auto to = [&](double degrees) { p.scene.twist_rad = degrees * units::pi / 180; };
  p.play(errors, 2.7, [&](int i) { to(i); });
  EXPECT_TRUE(p.events.empty());
  p.play(errors, 0.9, [&](int) { to(-280); });
  EXPECT_EQ(p.took(data::EventCode::tip_whips), 1);
  EXPECT_EQ(p.took(data::EventCode::wound_up), 0) << "not for a second yet";
  p.play(errors, 4, [&](int) { to(-280); });
  EXPECT_EQ(p.took(data::EventCode::wound_up), 1);
  p.play(errors, 5, [&](int) { to(0); });
  EXPECT_EQ(p.took(data::EventCode::tip_whips), 1);
  EXPECT_TRUE(p.events.empty());
}

TEST(Handling, AGuideSitsWhereItShould) {
  Played p;
  CatheterErrors errors;
  p.scene.catheter = guide;
  p[guide].sphere = 3;
  p.scene.catheter_cell = 9;
  p.play(errors, 10, [](int) {});
  EXPECT_TRUE(p.events.empty());
  p.scene.catheter_cell = 11;
  p.play(errors, 1.9, [](int) {});
  EXPECT_TRUE(p.events.empty());
  p.play(errors, 5, [](int) {});
  EXPECT_EQ(p.took(data::EventCode::deep_seat), 1);
  p.scene.catheter_cell = 2;
  p.scene.guide_trace = vascular::Trace::ventricularised;
  p.play(errors, 4.9, [](int) {});
  EXPECT_TRUE(p.events.empty());
  p.scene.guide_trace = vascular::Trace::damped;
  p.play(errors, 0.2, [](int) {});
  EXPECT_EQ(p.took(data::EventCode::bad_trace_kept), 1);
  EXPECT_TRUE(p.events.empty());
}

TEST(Handling, AThickWireStaysOnItsWay) {
  Played p;
  ThickWireErrors errors;
  p.scene.thick_wire = thick;
  p.play(errors, 5, [](int) {});
  EXPECT_TRUE(p.events.empty());
  p[thick].sphere = 1;
  p.play(errors, 5, [](int) {});
  EXPECT_EQ(p.took(data::EventCode::wire_strays), 1);
  p[thick].sphere = 2;
  p.play(errors, 1.9, [](int) {});
  EXPECT_TRUE(p.events.empty());
  p.play(errors, 1.9, [](int) {});
  EXPECT_EQ(p.took(data::EventCode::wire_in_ventricle), 1);
  p[thick].sphere = 3;
  p.play(errors, 0.1, [](int) {});
  EXPECT_EQ(p.took(data::EventCode::thick_wire_in_coronary), 1);
  EXPECT_TRUE(p.events.empty());
}

TEST(Handling, ACoronaryWireIsSeenAndGoesWhereItIsPlanned) {
  Played p;
  CoronaryWireErrors errors;
  p.scene.thin_wire = thin;
  p.play(errors, 8, [&](int i) { p.feed(thin, 1e-4), p.scene.wire_cell = i / 10; });
  EXPECT_TRUE(p.events.empty()) << "seen, 80 mm down the artery";
  p.scene.thin_tip_is_seen = false;
  p.play(errors, 0.9, [&](int i) { p.feed(thin, i % 2 ? 1e-4 : -1e-4); });
  EXPECT_EQ(p.took(data::EventCode::blind_wire), 0);
  p.play(errors, 0.2, [&](int i) { p.feed(thin, i % 2 ? 1e-4 : -1e-4); });
  EXPECT_EQ(p.took(data::EventCode::blind_wire), 1) << "there and back counts";
  EXPECT_TRUE(p.events.empty());
}

TEST(Handling, ACoronaryWireIsNotPushedIntoASideBranch) {
  Played p;
  CoronaryWireErrors errors;
  p.scene.thin_wire = thin;
  p.scene.wire_cell = 108;
  p.play(errors, 1, [&](int) { p.feed(thin, 1e-5); });
  EXPECT_EQ(p.took(data::EventCode::side_branch_pushed), 0) << "9 mm in";
  p.scene.wire_cell = 111;
  p.play(errors, 1, [&](int) { p.feed(thin, -1e-5); });
  EXPECT_EQ(p.took(data::EventCode::side_branch_pushed), 0) << "drawn back";
  p.play(errors, 1, [&](int) { p.feed(thin, 1e-5); });
  EXPECT_EQ(p.took(data::EventCode::side_branch_pushed), 1);
  EXPECT_TRUE(p.events.empty());
}

TEST(Handling, ACoronaryWireStaysBehindTheLesion) {
  Played p;
  CoronaryWireErrors errors;
  p.scene.thin_wire = thin;
  const auto lie = [&](int cell, double seconds = 1) { p.scene.wire_cell = cell, p.play(errors, seconds, [](int) {}); };
  lie(95, 4.9);
  EXPECT_TRUE(p.events.empty());
  lie(95, 0.2);
  EXPECT_EQ(p.took(data::EventCode::wire_too_far), 1) << "5 mm from the artery's end";
  lie(80);
  // A device is advanced; the wire moves with it; cardiac motion does not count.
  p.scene.device = balloon;
  p[balloon].feed_m_s = 0.02;
  lie(80);
  p.scene.diastasis = false;
  lie(90);
  p.scene.diastasis = true;
  lie(84);
  EXPECT_EQ(p.took(data::EventCode::wire_drift), 0);
  lie(86);
  EXPECT_EQ(p.took(data::EventCode::wire_drift), 1);
  p[balloon].feed_m_s = 0;
  lie(20);
  EXPECT_EQ(p.took(data::EventCode::wire_position_lost), 1) << "nobody drew it";
  EXPECT_EQ(p.took(data::EventCode::wire_drift), 1);
  p.scene.device = -1;
  lie(80);
  p.feed(thin, -55e-3);
  lie(25);
  EXPECT_TRUE(p.events.empty()) << "drawn back on purpose";
}

TEST(Handling, BeamAndPushAreForSomething) {
  ScriptedRun run(tools_in_place(), vessel_in_place());
  HandlingWatch watch(run.model);
  SessionInputs inputs;
  inputs.tools.resize(run.model.tools.size());
  SessionReport report;
  report.tools.resize(run.model.tools.size());
  Played p;
  const auto play = [&](double seconds, auto each) {
    for (int i = 0; i < std::lround(seconds / 0.01); ++i) {
      run.state.rods.step += HandlingWatch::every;
      each();
      watch.look(run.model, inputs, run.state, report, EventSink{run.state.rods.step, p.events});
    }
  };
  play(10, [] {});
  EXPECT_TRUE(p.events.empty()) << "no beam";
  inputs.c_arm.fluoroscopy = 1;
  play(2.9, [] {});
  EXPECT_TRUE(p.events.empty());
  play(3, [] {});
  EXPECT_EQ(p.took(data::EventCode::idle_beam), 1);
  inputs.delivery.injection_m3_s = 1e-6;
  play(10, [] {});
  EXPECT_TRUE(p.events.empty());
  // A tool whose tip stays where it is, at first with little force.
  report.tools[0].in_body = true;
  inputs.tools[0].feed_m_s = 0.05;
  play(2, [&] { run.state.hands[0].fed_m += 5e-4; });
  EXPECT_TRUE(p.events.empty());
  play(1, [&] { run.state.hands[0].fed_m += 5e-4, report.tools[0].push_N += 0.01; });
  EXPECT_EQ(p.took(data::EventCode::push_without_advance), 1);
  EXPECT_TRUE(p.events.empty());
}

TEST(Handling, ACasesMapKnowsItsWaysAndItsLesion) {
  const ScriptedRun run(tools_in_place(), vessel_in_place());
  const HandlingMap map(run.model);
  const VesselIndex& way = *run.model.vessel->way;
  const auto at = [&](const char* place) {
    EXPECT_GE(way.place(place), 0) << place;
    return static_cast<std::size_t>(way.place(place));
  };
  EXPECT_NEAR(map.astray_m[at("left carotid+30")], 30e-3, 3e-3);
  EXPECT_NEAR(map.astray_m[at("left subclavian+30")], 30e-3, 3e-3);
  for (const char* place : {"diaphragm", "arch", "ascending aorta", "valve", "RCA+20", "LM", "LAD+20"})
    EXPECT_EQ(map.astray_m[at(place)], 0) << place;
  // Where a wire slid along the arch's outer wall past a mouth, the branch's sphere was nearer than the aorta's.
  const auto branch_at = [&](const Eigen::Vector3d& p) {
    return way.branches()[static_cast<std::size_t>(tip_branch(map, way, way.locate(p, 0), p, 0))].name;
  };
  const int mouth = way.entry("right subclavian");
  int at_wall = 0;
  for (int k = 0; k < 7 * 7 * 7; ++k) {
    const Eigen::Vector3d p = way.p(mouth, 0) + 2e-3 * Eigen::Vector3d(k % 7 - 3, k / 7 % 7 - 3, k / 49 - 3);
    const int sphere = way.locate(p, 0);
    if (way.branch(sphere) != way.branch(mouth) || !way.in_parent(sphere, p, 0)) continue;
    ++at_wall;
    EXPECT_EQ(branch_at(p), "aorta");
  }
  EXPECT_GT(at_wall, 0) << "points of the aorta's lumen that are nearer to a sphere of the branch";
  EXPECT_EQ(branch_at(way.p(way.place("right subclavian+20"), 0)), "right subclavian");
  EXPECT_EQ(branch_at(way.p(way.entry("RCA"), 0)), "RCA") << "a coronary begins at its mouth";
  EXPECT_TRUE(map.before_root[at("arch")]);
  EXPECT_FALSE(map.before_root[at("ascending aorta")]);
  EXPECT_FALSE(map.before_root[at("valve")]);
  EXPECT_NEAR(map.in_coronary_m[at("RCA+20")], 20e-3, 2e-3);
  EXPECT_EQ(map.in_coronary_m[at("arch")], 0);

  const vascular::FlowTree& tree = run.model.physiology.flow.tree;
  const Plan& plan = run.model.vessel->coronaries->lesions[0];
  const auto cell = [&](const char* branch, double along_m) {
    return static_cast<std::size_t>(tree.cell_at(tree.branch(branch), along_m));
  };
  const std::size_t near = cell("RCA", 2e-3), far = cell("RCA", plan.to_m + 10e-3), conus = cell("Conus", 15e-3);
  EXPECT_FALSE(map.behind_lesion[near]);
  EXPECT_TRUE(map.behind_lesion[far]);
  EXPECT_EQ(map.unplanned_m[near], 0);
  EXPECT_EQ(map.unplanned_m[far], 0);
  EXPECT_NEAR(map.unplanned_m[conus], 15e-3, 5e-3);
  EXPECT_EQ(map.deep_m[near], 10e-3);
  const std::size_t lad = cell("LAD", 5e-3);
  EXPECT_LT(map.deep_m[lad], 8e-3) << "half of the left main";
  EXPECT_GT(map.to_end_m[near], 80e-3);
}

TEST(Handling, ABranchBetweenTwoLesionsLeadsAWireAstray) {
  RunSetup two = tools_in_place();
  set_vessel("rca-diffuse", vascular::LengthUnit::millimetre, two);
  std::string warnings;
  const ScriptedRun run(two, make_vessel(two, warnings));
  const HandlingMap map(run.model);
  const vascular::FlowTree& tree = run.model.physiology.flow.tree;
  const auto& lesions = run.model.vessel->coronaries->lesions;
  const auto cell = [&](const char* branch, double along_m) {
    return static_cast<std::size_t>(tree.cell_at(tree.branch(branch), along_m));
  };
  EXPECT_NEAR(map.unplanned_m[cell("RV", 15e-3)], 15e-3, 5e-3) << "it leaves behind the first lesion";
  const std::size_t between = cell("RCA", (lesions[0].to_m + lesions[1].from_m) / 2),
                    far = cell("RCA", lesions[1].to_m + 5e-3);
  EXPECT_EQ(map.unplanned_m[between], 0);
  EXPECT_FALSE(map.behind_lesion[between]);
  EXPECT_EQ(map.unplanned_m[far], 0);
  EXPECT_TRUE(map.behind_lesion[far]);
}

}  // namespace
}  // namespace ostium::app
