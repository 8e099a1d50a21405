/// Which lesions a treatment is judged by, and which sizes and guides are chosen for a vessel.
#include <gtest/gtest.h>

#include "app/angiography/textbook_treatment.h"
#include "app/session/model/outcome.h"
#include "app/session/run/run.h"
#include "data/assessment/metrics.h"
#include "data/catalogue/catalogue.h"
#include "data/catalogue/instrument/instrument_reader.h"
#include "data/formats/load_error.h"
#include "tests/app/session/short_treatment.h"

namespace ostium::app {
namespace {

/// Two lesions of one artery, 32 and 22 mm long with 14 mm between them, and three stents to cover them with.
RunSetup two_lesions(const std::string& condition = R"("seconds": 1)", const std::string& sizes = "") {
  RunSetup out;
  set_vessel("rca-diffuse", vascular::LengthUnit::millimetre, out);
  set_script(
      data::read_script("two.json", R"({ "schema": "ostium-script/1", "name": "two", "title": "A test", "tools": [
    { "name": "guide", "instrument": "guide-jr4-6f" },
    { "name": "proximal", "instrument": "stent-35x38" }, { "name": "distal", "instrument": "stent-30x28")" +
                                        sizes + R"( },
    { "name": "short", "instrument": "stent-35x23" }, { "name": "wire", "instrument": "wire-014-workhorse" } ],
    "steps": [ { "do": "wait", "until": [{ )" +
                                        condition + " }] } ] }"),
      out);
  return out;
}

std::shared_ptr<const Vessel> with_two_lesions() {
  static const std::shared_ptr<const Vessel> made = [] {
    std::string warnings;
    return make_vessel(two_lesions(), warnings);
  }();
  return made;
}

TEST(Lesions, AScriptIsRefusedOnACaseWithAnotherAccess) {
  const data::Script from_the_wrist = data::find_script("pci-lcx-tubular-radial"),
                     from_anywhere = data::find_script("jr4-engages-rca");
  RunSetup groin, wrist;
  set_vessel("lcx-tubular", vascular::LengthUnit::millimetre, groin);
  set_vessel("lcx-tubular-radial", vascular::LengthUnit::millimetre, wrist);
  EXPECT_NO_THROW(set_script(from_the_wrist, wrist));
  EXPECT_NO_THROW(set_script(from_anywhere, groin));
  EXPECT_NO_THROW(set_script(from_anywhere, wrist));
  try {
    set_script(from_the_wrist, groin);
    FAIL() << "accepted";
  } catch (const data::LoadError& error) {
    for (const char* word : {"pci-lcx-tubular-radial.json", "radial access", "lcx-tubular has femoral access"})
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
  }
}

TEST(Lesions, AScriptIsRefusedOnACaseWithItsLesionsElsewhere) {
  RunSetup setup = two_lesions();
  const auto plan_of = [&](const std::string& branch) {
    setup.script.lesions_in = {"RCA", branch};
    const SessionModel model = make_session(setup, with_two_lesions());
    return make_plan(setup.script, model, 0);
  };
  EXPECT_NO_THROW(plan_of("RCA"));
  try {
    plan_of("D1");
    FAIL() << "accepted";
  } catch (const data::LoadError& error) {
    for (const char* word : {"two.json", "a lesion of D1", "rca-diffuse has lesions in: RCA, RCA"})
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
  }
  setup.script.by_hand = true;
  EXPECT_NO_THROW(plan_of("D1")) << "people see where they are";
}

/// At an artery's origin and end, too, where there is healthy wall on one side only.
TEST(Lesions, ALesionIsAsNarrowAsItsFileSaysWhereverItLies) {
  const vascular::Anatomy anatomy = vascular::make_patient(vascular::AnatomyParameters{}, {}).anatomy;
  for (const char* branch : {"LM", "LAD", "LCx", "RCA"}) {
    const double length_m = find_branch(anatomy, branch)->length_m();
    for (const double from_m : {0.0, length_m - 6e-3}) {
      const vascular::Lesion lesion{.branch = branch, .from_m = from_m, .length_m = 6e-3, .stenosis = 0.6};
      if (from_m < 0 || from_m + lesion.length_m > length_m) continue;
      const vascular::Patient patient = vascular::make_patient(vascular::AnatomyParameters{}, {lesion});
      const vascular::FlowModel flow = vascular::make_flow_model(vascular::flow_tree_of(patient));
      const Treatable plan = plan_treatment(patient, flow, 0);
      const LesionNumbers before = measure(plan.plans[0], flow, make_plaque_state(plan.model.plaque));
      EXPECT_NEAR(before.stenosis_percent, 60, 8) << branch << " from " << 1e3 * from_m << " mm";
    }
  }
}

TEST(Lesions, EachLesionIsJudgedByTheStentsAtIt) {
  ScriptedRun run(two_lesions(), with_two_lesions());
  const SessionModel& model = run.model;
  const auto& lesions = model.vessel->coronaries->lesions;
  ASSERT_EQ(lesions.size(), 2u);
  const double artery = model.physiology.flow.tree.branch("RCA");
  const auto middle_m = [&](std::size_t i) { return (lesions[i].from_m + lesions[i].to_m) / 2; };
  const auto lies = [&](std::size_t stent, double at_m) {
    vascular::StentState& own = run.state.treatment.stents[stent];
    own.where = vascular::StentState::deployed, own.branch = artery, own.middle_m = at_m, own.shift_m = 0;
  };
  const auto covered = [&](int lesion) { return lesion_is_covered(model, run.state, 2e-3, lesion); };
  EXPECT_FALSE(covered(0) || covered(1));
  EXPECT_FALSE(worst_of_lesions(model, run.state).margin_m);
  EXPECT_NEAR(worst_of_lesions(model, run.state).stenosis, 0.75, 0.02);
  EXPECT_NEAR(lesion_now(model, run.state, 0).stenosis, 0.65, 0.02);

  lies(1, middle_m(1));  // 28 mm on 22: 3 mm on either side
  EXPECT_TRUE(covered(1));
  EXPECT_FALSE(covered(0));
  EXPECT_LT(*worst_of_lesions(model, run.state).margin_m, 0) << "of the other";
  EXPECT_NEAR(*stent_from_lesion_m(model, run.state, 1, 1), 0, 0.3e-3);

  lies(2, lesions[0].from_m + 8e-3);  // 23 mm on 32: what lies between the stents is not covered
  EXPECT_FALSE(covered(0));
  EXPECT_NEAR(stented(model, run.state, 0)->from_m, -3.5e-3, 0.5e-3);
  EXPECT_NEAR(stented(model, run.state, 0)->to_m, 19.5e-3, 0.5e-3);

  lies(0, lesions[0].from_m + 45e-3);  // from 26 mm: nor what lies between stents in the lesion itself
  EXPECT_FALSE(covered(0));
  lies(0, lesions[0].from_m + 35e-3);  // from 16 mm: all three are joined
  EXPECT_TRUE(covered(0) && covered(1));
  EXPECT_NEAR(stented(model, run.state, 0)->to_m - stented(model, run.state, 0)->from_m, 74.5e-3, 1e-3);

  run.state.treatment.stents[2].where = vascular::StentState::lost;
  lies(0, middle_m(0));  // 38 mm on 32
  EXPECT_TRUE(covered(0) && covered(1));
  EXPECT_NEAR(stented(model, run.state, 0)->to_m, 35e-3, 0.5e-3) << "not to the end of the other one's";
  EXPECT_NEAR(*worst_of_lesions(model, run.state).margin_m, 3e-3, 0.5e-3);

  run.state.coupling.balloons[0].tool = 1, run.state.coupling.balloons[0].balloon = 1,
  run.state.coupling.balloons[0].branch = artery, run.state.treatment.balloons[0].seat_m = middle_m(1);
  EXPECT_NEAR(*balloon_from_lesion_m(model, run.state, 1), 0, 1e-6);
  EXPECT_NEAR(*balloon_from_lesion_m(model, run.state, 0), 41e-3, 0.5e-3);
  // Its markers, 28.5 mm apart, over 22 mm: so far beyond at both ends in the middle, less at one end beside it.
  const double length_m = model.treatment.balloons[1].length_m, ill_m = lesions[1].to_m - lesions[1].from_m;
  EXPECT_NEAR(*balloon_beyond_lesion_m(model, run.state, 1), (length_m - ill_m) / 2, 1e-6);
  EXPECT_GT(*balloon_beyond_lesion_m(model, run.state, 1), 2e-3);
  for (const double aside_m : {-4e-3, 4e-3}) {
    run.state.treatment.balloons[0].seat_m = middle_m(1) + aside_m;
    EXPECT_NEAR(*balloon_beyond_lesion_m(model, run.state, 1), (length_m - ill_m) / 2 - 4e-3, 1e-6);
  }
  run.state.treatment.balloons[0].seat_m = middle_m(1);
}

TEST(Lesions, ALesionThatThereIsNotIsRefused) {
  const auto refusal = [](const std::string& condition, const std::string& sizes) -> std::string {
    try {
      RunSetup own = two_lesions(condition, sizes);
      choose_sizes(*with_two_lesions(), own);
      ScriptedRun run(own, with_two_lesions());
      return data::read_instrument(own.tool_files[2], own.tool_texts[2]).name;
    } catch (const data::LoadError& error) {
      return error.what();
    }
  };
  const std::string sizes = R"(, "sizes": ["stent-275x28", "stent-325x28"], "of_reference": 1.05)";
  EXPECT_EQ(refusal(R"("balloon_at_mm": 0)", sizes), "stent-325x28");
  EXPECT_EQ(refusal(R"("balloon_at_mm": 0, "lesion": 2)", sizes + R"(, "lesion": 2)"), "stent-275x28");
  const std::string condition = refusal(R"("balloon_at_mm": 0, "lesion": 3)", sizes),
                    tool = refusal(R"("seconds": 1)", sizes + R"(, "lesion": 3)");
  EXPECT_NE(condition.find("two.json:5: balloon_at_mm 0 of lesion 3: this patient's lesions are 2"), std::string::npos)
      << condition;
  EXPECT_NE(tool.find("two.json:3: distal is for lesion 3; this patient's lesions are 2"), std::string::npos) << tool;
}

TEST(ToolChoice, AlternativesLieIdleOutside) {
  ScriptedRun run(setup(), vessel());
  EXPECT_EQ(in_the_way(run.model, run.state.rods, 2).tool, -1) << "nothing is in the body";
  EXPECT_EQ(run.model.balloon_of, (std::vector<int>{-1, 0, 1, -1}));
  EXPECT_EQ(run.model.treatment.stent_on, (std::vector<int>{-1, 0}));
  EXPECT_NEAR(run.model.treatment.stents[0].length_m, 15e-3, 1e-12);
}

/// What the third tool of predilatation becomes if it comes in `sizes`, measured `by` so much; `set`: asked for by
/// name.
std::string taken_size(const std::string& sizes, const std::string& by, const std::string& set) {
  std::string script = predilatation;
  const std::string plain = R"("instrument": "stent-325x15")";
  script.replace(script.find(plain), plain.size(), plain + ", \"sizes\": [" + sizes + "], " + by);
  RunSetup own;
  set_vessel("rca-mid-focal", vascular::LengthUnit::millimetre, own);
  set_script(data::read_script("predilatation.json", script), own);
  if (!set.empty()) set_value("stent", set, own);
  choose_sizes(*vessel(), own);
  return data::read_instrument(own.tool_files[2], own.tool_texts[2]).name;
}

TEST(ToolChoice, SizesAreChosenByTheArtery) {
  ASSERT_NEAR(vessel()->coronaries->lesions[0].reference_m, 3.46e-3, 0.05e-3);
  const auto taken = [](const std::string& sizes, const std::string& share, const std::string& set = "") {
    return taken_size(sizes, "\"of_reference\": " + share, set);
  };
  const std::string all = R"("stent-40x18", "stent-25x18", "stent-35x18", "stent-30x18", "stent-325x18")";
  EXPECT_EQ(taken(all, "1.05"), "stent-35x18");
  EXPECT_EQ(taken(all, "1"), "stent-325x18");
  EXPECT_EQ(taken(all, "0.5"), "stent-25x18") << "the narrowest, where all are wider";
  EXPECT_EQ(taken(all, "1.05", "stent-30x18"), "stent-30x18") << "asked for by name";
  EXPECT_THROW(taken(R"("wire-014-workhorse")", "1"), data::LoadError);
  EXPECT_THROW(taken(R"("zebra")", "1"), data::LoadError);
}

TEST(ToolChoice, GuidesAreChosenByTheAorta) {
  ASSERT_NEAR(ascending_diameter_m(*vessel()), 30.9e-3, 0.5e-3) << "Hager 2002, the mean";
  const auto taken = [](const std::string& sizes, const std::string& share) {
    return taken_size(sizes, "\"of_aorta\": " + share, "");
  };
  const std::string both = R"("guide-ebu35-6f", "guide-ebu30-6f")";
  EXPECT_EQ(taken(both, "1.35"), "guide-ebu35-6f") << "40 mm";
  EXPECT_EQ(taken(both, "1.2"), "guide-ebu30-6f") << "35 mm";
  EXPECT_EQ(taken(both, "0.5"), "guide-ebu30-6f") << "the narrowest, where both are wider";
  EXPECT_THROW(taken(R"("stent-30x18")", "1.35"), data::LoadError) << "has no width";
}

TEST(ToolChoice, ABeginningThatIsNoArteryIsRefused) {
  RunSetup wrong = setup();
  for (const char* artery : {"RCX", "LAD"}) {
    try {
      set_value("begin", artery, wrong);
      FAIL() << artery;
    } catch (const data::LoadError& error) {
      EXPECT_NE(std::string(error.what()).find("LM or RCA"), std::string::npos) << error.what();
    }
  }
  set_value("begin", "RCA", wrong);
  set_value("begin", "", wrong);  // from the groin or the wrist again
}

}  // namespace
}  // namespace ostium::app
