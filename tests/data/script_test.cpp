/// Scripts that ship load; what is wrong in one is named by file, line and what was expected.
#include "data/catalogue/script/script.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "data/catalogue/catalogue.h"
#include "data/catalogue/script/script_keys.h"
#include "tests/data/refusals.h"

namespace ostium::data {
namespace {

namespace fs = std::filesystem;

const std::string small_script = R"({
  "schema": "ostium-script/1",
  "name": "small",
  "title": "A test",
  "tools": [ { "name": "guide", "instrument": "guide-jr4-6f" }, { "name": "wire", "instrument": "cook-j" } ],
  "steps": [
    { "do": "view", "view": "spider" },
    { "do": "advance", "label": "up", "tool": "wire", "speed_mm_s": 50,
      "until": [{ "tip_passes": "arch" }], "unless": [{ "push_exceeds_N": 5 }], "timeout_s": 20 },
    { "do": "turn", "tool": ["guide", "wire"], "turn_deg_s": -90, "until": [{ "turned_deg": 180 }, { "seconds": 3 }],
      "otherwise": "up", "tries": 2 },
    { "do": "wait", "until": [{ "tip_points": "left", "within_deg": 20, "of": "wire" }] }
  ]
})";

/// What is said of a script that is refused.
template <class Read>
std::string refusal_of(Read&& read) {
  try {
    read();
  } catch (const LoadError& error) {
    return error.what();
  }
  return "accepted";
}

std::string refusal(const std::string& from, const std::string& to) {
  std::string text = small_script;
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  return refusal_of([&] { read_script("folder/small.json", text); });
}

TEST(Script, IsReadInSiUnits) {
  const Script script = read_script("folder/small.json", small_script);
  ASSERT_EQ(script.steps.size(), 4u);
  EXPECT_NEAR(*script.steps[0].lao_rad, 0.7854, 1e-4);
  const ScriptStep& up = script.steps[1];
  EXPECT_DOUBLE_EQ(up.feed_m_s, 0.05);
  EXPECT_EQ(up.tools, std::vector<int>{1});
  EXPECT_EQ(up.until[0].kind, ConditionKind::tip_passes);
  EXPECT_EQ(up.until[0].tool, 1);
  EXPECT_EQ(up.unless[0].words, "push_exceeds_N 5");
  const ScriptStep& turn = script.steps[2];
  EXPECT_EQ(turn.tools, (std::vector<int>{0, 1}));
  EXPECT_NEAR(turn.turn_rad_s, -1.5708, 1e-4);
  EXPECT_EQ(turn.jump_to, 1);
  EXPECT_EQ(turn.tries, 2);
  EXPECT_EQ(script.steps[3].until[0].direction_P, Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(script.steps[3].until[0].words, "tip_points left of wire");
}

TEST(Script, MistakesAreNamedByLine) {
  expect_words(refusal("\"speed_mm_s\"", "\"speed_mms\""),
               {"folder/small.json:8:", "speed_mms is not a key of the step"});
  expect_words(refusal("\"tip_passes\"", "\"tip_pases\""),
               {"folder/small.json:9:", "tip_pases is not a key of the condition"});
  expect_words(refusal("\"tool\": \"wire\"", "\"tool\": \"wyre\""),
               {"small.json:8:", "one of the script's tools: guide, wire"});
  expect_words(refusal("\"speed_mm_s\": 50,", ""), {"small.json:8:", "speed_mm_s is missing", "\"advance\" needs it"});
  expect_words(refusal("\"speed_mm_s\": 50", "\"speed_mm_s\": -50"), {"small.json:8:", "is -50", "> 0"});
  expect_words(refusal("\"do\": \"advance\"", "\"do\": \"push\""), {"small.json:8:", "advance, withdraw, turn"});
  expect_words(refusal("\"view\": \"spider\"", "\"view\": \"spyder\""), {"small.json:7:", "ostium views"});
  expect_words(refusal("\"view\": \"spider\"", "\"view\": \"spider\", \"on\": true"),
               {"small.json:7:", "no meaning for \"view\""});
  expect_words(refusal("\"otherwise\": \"up\"", "\"otherwise\": \"down\""), {"small.json:11:", "the label of a step"});
  expect_words(refusal("\"tries\": 2", "\"tries\": 0"), {"small.json:11:", "1 to 100"});
  expect_words(refusal("\"otherwise\": \"up\", \"tries\": 2", "\"last_resort\": \"up\""),
               {"small.json:11:", "beside otherwise"});
  EXPECT_EQ(refusal("\"tries\": 2", "\"last_resort\": \"up\""), "accepted") << "once, then there";
  expect_words(refusal("\"tries\": 2", "\"tries\": 2, \"last_resort\": \"down\""),
               {"small.json:11:", "the label of a step"});
  EXPECT_EQ(refusal("\"label\": \"up\"", "\"label\": \"up\", \"detour\": true"), "accepted");
  expect_words(refusal("\"label\": \"up\"", "\"label\": \"up\", \"detour\": 1"), {"small.json:8:", "true"});
  expect_words(refusal("\"view\": \"spider\"", "\"view\": \"spider\", \"detour\": true"),
               {"small.json:7:", "Not the first step"});
  expect_words(refusal(", \"within_deg\": 20", ""), {"small.json:12:", "within_deg is missing"});
  expect_words(refusal("\"tip_points\": \"left\", \"within_deg\": 20", "\"tip_faces\": \"RCA\""),
               {"small.json:12:", "within_deg is missing"});
  EXPECT_EQ(refusal("\"tip_points\": \"left\"", "\"tip_faces\": \"RCA\""), "accepted");
  const std::string points = "\"tip_points\": \"left\", \"within_deg\": 20";
  EXPECT_EQ(refusal(points, "\"tip_on\": \"LAD\""), "accepted");
  EXPECT_EQ(refusal(points, "\"tip_astray\": \"LAD\", \"by_mm\": 5"), "accepted");
  expect_words(refusal(points, "\"tip_astray\": \"LAD\""), {"small.json:12:", "by_mm is missing"});
  expect_words(refusal(points, "\"tip_on\": \"LAD\", \"by_mm\": 5"), {"small.json:12:", "by_mm"});
  expect_words(refusal("{ \"seconds\": 3 }", "{ \"seconds\": 3, \"beats\": 2 }"),
               {"small.json:10:", "both seconds and beats"});
  expect_words(refusal("{ \"seconds\": 3 }", "{ }"), {"small.json:10:", "says nothing to look at"});
  expect_words(refusal("\"label\": \"up\"", "\"label\": \"up\", \"timeout_s\": 0"), {"small.json:"});
  expect_words(refusal("{ \"name\": \"wire\"", "{ \"name\": \"guide\""),
               {"small.json:5:", "another tool of that name"});
  expect_words(refusal("\"until\": [{ \"tip_passes\": \"arch\" }],", "\"until\": [],"),
               {"small.json:9:", "a list of conditions"});
  expect_words(refusal(", \"of\": \"wire\"", ""), {"small.json:12:", "does not say of which tool"});
}

const std::string treatment = R"({
  "schema": "ostium-script/1", "name": "treatment", "title": "A test",
  "tools": [ { "name": "guide", "instrument": "guide-jr4-6f" }, { "name": "balloon", "instrument": "balloon-25x15" } ],
  "steps": [
    { "do": "drug", "heparin_U": 5000 },
    { "do": "inject", "rate_mL_s": 3, "volume_mL": 6, "iodine_mg_mL": 0 },
    { "do": "advance", "tool": "balloon", "speed_mm_s": 20, "until": [{ "balloon_at_mm": -2 }, { "balloon_within_mm": 1 }] },
    { "do": "inflate", "gauge_atm": 10, "over_s": 5 },
    { "do": "wait", "until": [{ "balloon_open": true }, { "trace": "damped" }, { "unharmed": true }, { "contrast_in": "RCA+30" }] },
    { "do": "deflate", "unless": [{ "ST_exceeds_mV": 0.2 }] }
  ]
})";

std::string treatment_refusal(const std::string& from, const std::string& to) {
  std::string text = treatment;
  EXPECT_NE(text.find(from), std::string::npos) << from;
  text.replace(text.find(from), from.size(), to);
  return refusal_of([&] { read_script("treatment.json", text); });
}

TEST(Script, SaysWhereItComesIn) {
  const auto with = [](const std::string& access) {
    return read_script("up.json", R"({ "schema": "ostium-script/1", "name": "up", "title": "A test",)" + access + R"(
      "tools": [ { "name": "wire", "instrument": "cook-j" } ],
      "steps": [ { "do": "wait", "until": [ { "seconds": 1 } ] } ] })")
        .access;
  };
  EXPECT_EQ(with(""), std::nullopt);
  EXPECT_EQ(with(R"( "access": "radial",)"), vascular::Access::radial);
  EXPECT_EQ(with(R"( "access": "femoral",)"), vascular::Access::femoral);
  EXPECT_THROW(with(R"( "access": "brachial",)"), LoadError);
}

TEST(Script, ToolsMayComeInSizes) {
  const std::string tool = R"("instrument": "balloon-25x15")";
  const auto with = [&](const std::string& more) { return treatment_refusal(tool, tool + ", " + more); };
  EXPECT_EQ(with(R"("sizes": ["balloon-20x10", "balloon-25x15"], "of_reference": 0.8)"), "accepted");
  expect_words(with(R"("sizes": ["balloon-20x10"])"), {"treatment.json:3:", "both or neither"});
  expect_words(with(R"("of_reference": 0.8)"), {"treatment.json:3:", "both or neither"});
  expect_words(with(R"("sizes": [], "of_reference": 0.8)"), {"treatment.json:3:", "sizes"});
  expect_words(with(R"("sizes": [3], "of_reference": 0.8)"), {"treatment.json:3:", "sizes"});
  expect_words(with(R"("sizes": ["balloon-20x10"], "of_reference": 2)"), {"treatment.json:3:", "at most 1.5"});
  EXPECT_EQ(with(R"("sizes": ["guide-ebu30-6f", "guide-ebu35-6f"], "of_aorta": 1.35)"), "accepted");
  expect_words(with(R"("of_aorta": 1.35)"), {"treatment.json:3:", "both or neither"});
  expect_words(with(R"("sizes": ["balloon-20x10"], "of_aorta": 1.35, "of_reference": 0.8)"),
               {"treatment.json:3:", "of_aorta", "instead of"});
  expect_words(with(R"("sizes": ["guide-ebu30-6f"], "of_aorta": 4)"), {"treatment.json:3:", "at most 3"});
  expect_words(with(R"("sizes": ["guide-ebu30-6f"], "of_aorta": 1.35, "lesion": 2)"), {"treatment.json:3:", "lesion"});
}

TEST(Script, LooksAtTheLesionThatIsNamed) {
  const std::string at = R"("balloon_at_mm": -2)";
  std::string text = treatment;
  text.replace(text.find(at), at.size(), at + R"(, "lesion": 2)");
  const ScriptStep step = read_script("treatment.json", text).steps[2];
  EXPECT_EQ(step.until[0].lesion, 1);
  EXPECT_EQ(step.until[0].words, "balloon_at_mm -2 of lesion 2");
  EXPECT_EQ(step.until[1].lesion, 0) << "the first, where it is not said";
  EXPECT_EQ(treatment_refusal("\"balloon_within_mm\": 1", R"("stent_beyond_mm": 2, "lesion": 3)"), "accepted");
  expect_words(treatment_refusal(at, at + R"(, "lesion": 0)"), {"treatment.json:7:", "lesion is 0", "from 1 on"});
  expect_words(treatment_refusal(at, at + R"(, "lesion": 1.5)"), {"treatment.json:7:", "lesion is 1.5"});
  expect_words(treatment_refusal("\"trace\": \"damped\"", R"("trace": "damped", "lesion": 2)"),
               {"treatment.json:9:", "lesion"});
  const std::string tool = R"("instrument": "balloon-25x15")";
  const std::string sizes = R"(, "sizes": ["balloon-20x10"], "of_reference": 0.8)";
  EXPECT_EQ(treatment_refusal(tool, tool + sizes + R"(, "lesion": 2)"), "accepted");
  expect_words(treatment_refusal(tool, tool + R"(, "lesion": 2)"), {"treatment.json:3:", "beside sizes"});
}

TEST(Script, TreatsInSiUnits) {
  const Script script = read_script("treatment.json", treatment);
  EXPECT_EQ(script.steps[0].heparin_U, 5000);
  EXPECT_NEAR(script.steps[1].rate_m3_s, 3e-6, 1e-18);
  EXPECT_NEAR(script.steps[1].volume_m3, 6e-6, 1e-18);
  EXPECT_EQ(script.steps[1].iodine_kg_m3, 0);
  EXPECT_NEAR(script.steps[2].until[0].value, -2e-3, 1e-15);
  EXPECT_EQ(script.steps[2].until[1].kind, ConditionKind::balloon_within);
  EXPECT_NEAR(script.steps[2].until[1].value, 1e-3, 1e-15);
  expect_words(treatment_refusal("\"balloon_within_mm\": 1", "\"stent_beyond_mm\": 0"), {"treatment.json:", "> 0"});
  EXPECT_EQ(treatment_refusal("\"balloon_within_mm\": 1", "\"stent_beyond_mm\": 2"), "accepted");
  EXPECT_EQ(treatment_refusal("\"balloon_within_mm\": 1", "\"balloon_clear_of_guide_mm\": 2"), "accepted");
  EXPECT_NEAR(script.steps[3].gauge_Pa, 1013250, 1e-6);
  EXPECT_EQ(script.steps[4].until[1].place, "damped");
  EXPECT_NEAR(script.steps[5].unless[0].value, 0.2e-3, 1e-15) << "V";
  expect_words(treatment_refusal("\"volume_mL\": 6", "\"volume_mL\": -6"), {"is -6", "> 0"});
  expect_words(treatment_refusal(", \"volume_mL\": 6", ""), {"volume_mL is missing", "\"inject\" needs it"});
  expect_words(treatment_refusal("\"gauge_atm\": 10", "\"gauge_atm\": 40"), {"is 40", "0 to 30"});
  expect_words(treatment_refusal("\"heparin_U\": 5000", "\"label\": \"x\""), {"gives nothing", "heparin_U"});
  expect_words(treatment_refusal("\"damped\"", "\"wet\""), {"normal, damped, ventricularised"});
  expect_words(treatment_refusal("\"balloon_open\": true", "\"balloon_open\": false"), {"balloon_open is false"});
}

/// A folder of its own, removed at the end.
struct Folder {
  fs::path path = fs::temp_directory_path() / ("ostium-script-" + std::to_string(::getpid()));
  Folder() { fs::create_directories(path / "parts"); }
  ~Folder() { fs::remove_all(path); }
  void write(const std::string& name, const std::string& text) const { std::ofstream(path / name) << text; }
};

const std::string wire_part = R"({
  "schema": "ostium-script/1", "name": "up", "title": "A part", "tools": [ { "name": "wire", "instrument": "cook-j" } ],
  "steps": [
    { "do": "advance", "label": "up", "tool": "wire", "speed_mm_s": 12.5, "until": [{ "tip_passes": "arch" }] },
    { "do": "wait", "until": [{ "seconds": 2 }], "otherwise": "up", "tries": 2 }
  ]
})";

std::string whole(const std::string& steps) {
  return R"({ "schema": "ostium-script/1", "name": "whole", "title": "A test", "tools": [
    { "name": "guide", "instrument": "guide-jr4-6f" }, { "name": "wire", "instrument": "terumo-4f" } ], "steps": [)" +
         steps + "] }";
}

TEST(Script, StepsOfAnotherScriptStandWhereItIsNamed) {
  const Folder folder;
  folder.write("parts/up.json", wire_part);
  folder.write("whole.json", whole(R"({ "do": "fluoroscopy", "on": true }, { "do": "script", "script": "parts/up" },
    { "do": "fluoroscopy", "on": false })"));
  const Script script = load_script((folder.path / "whole.json").string());
  ASSERT_EQ(script.steps.size(), 4u);
  EXPECT_NEAR(script.steps[1].feed_m_s, 0.0125, 1e-15);
  EXPECT_EQ(script.steps[1].tools, std::vector<int>{1}) << "by its name, in the script that it stands in";
  EXPECT_EQ(script.tools[1].instrument, "terumo-4f");
  EXPECT_EQ(script.steps[2].jump_to, 1);

  // What a recording keeps needs no other file, and is the same script.
  fs::remove(folder.path / "parts/up.json");
  const Script again = read_script("whole.json", script.source);
  ASSERT_EQ(again.steps.size(), 4u);
  EXPECT_EQ(again.steps[1].feed_m_s, script.steps[1].feed_m_s);
  EXPECT_EQ(again.steps[2].jump_to, 1);
  EXPECT_EQ(again.source, script.source);
}

TEST(Script, AnotherScriptMayStandTwiceWithOtherToolsAtAnotherLesion) {
  const Folder folder;
  folder.write("parts/open.json", R"({ "schema": "ostium-script/1", "name": "open", "title": "A part", "tools": [
    { "name": "guide", "instrument": "guide-jr4-6f" }, { "name": "stent", "instrument": "stent-30x18" } ], "steps": [
      { "do": "advance", "label": "in", "tool": ["guide", "stent"], "speed_mm_s": 4, "until": [{ "balloon_at_mm": 0 }] },
      { "do": "wait", "until": [{ "stent_beyond_mm": 2, "lesion": 3 }, { "seconds": 1 }],
        "unless": [{ "push_exceeds_N": 1, "of": "stent" }], "otherwise": "in", "tries": 2 },
      { "do": "wait", "label": "seen", "until": [{ "seconds": 1 }], "otherwise": "go on" } ] })");
  const auto both = [](const std::string& with) {
    return R"({ "schema": "ostium-script/1", "name": "both", "title": "A test", "tools": [
      { "name": "guide", "instrument": "guide-jr4-6f" }, { "name": "stent", "instrument": "stent-30x18" },
      { "name": "other", "instrument": "stent-30x18" } ], "steps": [
        { "do": "script", "script": "parts/open", "label": "distal", "lesion": 2, "with": )" +
           with + R"( }, { "do": "script", "script": "parts/open" } ] })";
  };
  const std::string file = (folder.path / "both.json").string();
  for (const std::string& source :
       {both(R"({ "stent": "other" })"), read_script(file, both(R"({ "stent": "other" })")).source}) {
    const Script script = read_script(file, source);
    ASSERT_EQ(script.steps.size(), 6u);
    EXPECT_EQ(script.steps[0].label, "distal: in");
    EXPECT_EQ(script.steps[0].tools, (std::vector<int>{0, 2}));
    EXPECT_EQ(script.steps[0].until[0].lesion, 1);
    EXPECT_EQ(script.steps[1].until[0].lesion, 2) << "it says which itself";
    EXPECT_EQ(script.steps[1].unless[0].tool, 2);
    EXPECT_EQ(script.steps[1].jump_to, 0);
    EXPECT_EQ(script.steps[2].label, "distal: seen");
    EXPECT_EQ(script.steps[2].otherwise, ScriptStep::Otherwise::go_on);
    EXPECT_EQ(script.steps[3].label, "in");
    EXPECT_EQ(script.steps[3].tools, (std::vector<int>{0, 1}));
    EXPECT_EQ(script.steps[3].until[0].lesion, 0);
    EXPECT_EQ(script.steps[4].jump_to, 3);
  }
  const auto refused = [&](const std::string& with) { return refusal_of([&] { read_script(file, both(with)); }); };
  expect_words(refused(R"({ "steent": "other" })"), {"both.json:4:", "with.steent", "a tool of parts/open"});
  expect_words(refused(R"({ "stent": "others" })"), {"both.json:4:", "with.stent", "one of this script's"});
  expect_words(refused("3"), {"both.json:4:", "an object of names"});
  expect_words(refused(R"({ "stent": 3 })"), {"both.json:4:", "with.stent"});
}

TEST(Script, StepsOfAnotherScriptLeadToTheLabelBesideItWhereTheRunWouldEnd) {
  const Folder folder;
  folder.write("parts/up.json", R"({
    "schema": "ostium-script/1", "name": "up", "title": "A part", "tools": [ { "name": "wire", "instrument": "cook-j" } ],
    "steps": [
      { "do": "advance", "label": "up", "tool": "wire", "speed_mm_s": 12.5, "until": [{ "tip_passes": "arch" }] },
      { "do": "wait", "until": [{ "seconds": 2 }], "otherwise": "up", "tries": 2 },
      { "do": "wait", "until": [{ "seconds": 2 }], "otherwise": "up", "tries": 3, "last_resort": "up" },
      { "do": "wait", "until": [{ "seconds": 2 }], "otherwise": "go on" },
      { "do": "wait", "until": [{ "seconds": 2 }], "otherwise": "fail" },
      { "do": "cine", "on": true }
    ] })");
  const auto with = [&](const std::string& more) {
    return whole(
        R"({ "do": "fluoroscopy", "on": true }, { "do": "fluoroscopy", "label": "anew", "detour": true, "on": true },
      { "do": "script", "script": "parts/up", "label": "first")" +
        more + " }");
  };
  const std::string file = (folder.path / "whole.json").string();
  const Script script = read_script(file, with(R"(, "otherwise": "anew", "tries": 4)"));
  ASSERT_EQ(script.steps.size(), 8u);
  const ScriptStep* of_part = &script.steps[2];
  EXPECT_EQ(of_part[0].jump_to, 1);
  EXPECT_EQ(of_part[0].tries, 4);
  EXPECT_EQ(of_part[1].jump_to, 2) << "what it says itself comes first";
  EXPECT_EQ(of_part[1].tries, 2);
  EXPECT_EQ(of_part[1].last_resort, 1);
  EXPECT_EQ(of_part[2].last_resort, 2) << "its own";
  EXPECT_EQ(of_part[3].otherwise, ScriptStep::Otherwise::go_on);
  EXPECT_EQ(of_part[4].otherwise, ScriptStep::Otherwise::fail);

  const auto refused = [&](const std::string& more) { return refusal_of([&] { read_script(file, with(more)); }); };
  expect_words(refused(R"(, "otherwise": "nowhere")"), {"otherwise", "nowhere", "the label of a step"});
  expect_words(refused(R"(, "otherwise": "go on")"), {"whole.json:", "otherwise"});
  expect_words(refused(R"(, "tries": 2)"), {"whole.json:", "tries"});
  expect_words(refused(R"(, "otherwise": "anew", "tries": 0.5)"), {"tries", "a whole number"});
}

TEST(Script, ValuesOfAnotherScriptMayBeSaidAnew) {
  const Folder folder;
  folder.write("parts/up.json", R"({ "schema": "ostium-script/1", "name": "up", "title": "A part",
    "values": { "far_mm": 40, "turned": false },
    "tools": [ { "name": "wire", "instrument": "cook-j" } ],
    "steps": [
      { "do": "advance", "tool": "wire", "speed_mm_s": 10, "until": [{ "fed_mm": "$far_mm" }] },
      { "do": "turn", "when": "$turned", "tool": "wire", "turn_deg_s": 90, "until": [{ "turned_deg": 90 }] },
      { "do": "wait", "when_not": "$turned", "until": [{ "seconds": 1 }] } ] })");
  const std::string file = (folder.path / "whole.json").string();
  const auto with = [&](const std::string& more) {
    return whole(R"({ "do": "script", "script": "parts/up")" + more + " }");
  };
  const Script as_it_is = read_script(file, with(""));
  ASSERT_EQ(as_it_is.steps.size(), 2u);
  EXPECT_NEAR(as_it_is.steps[0].until[0].value, 0.04, 1e-15);
  EXPECT_EQ(as_it_is.steps[1].action, ScriptAction::wait);
  const Script anew = read_script(file, with(R"(, "values": { "far_mm": 75, "turned": true })"));
  ASSERT_EQ(anew.steps.size(), 2u);
  EXPECT_NEAR(anew.steps[0].until[0].value, 0.075, 1e-15);
  EXPECT_EQ(anew.steps[0].until[0].words, "fed_mm 75");
  EXPECT_EQ(anew.steps[1].action, ScriptAction::turn);

  const auto refused = [&](const std::string& values) {
    return refusal_of([&] { read_script(file, with(", \"values\": " + values)); });
  };
  expect_words(refused(R"({ "for_mm": 75 })"), {"whole.json:", "values.for_mm", "far_mm, turned"});
  expect_words(refused(R"({ "far_mm": true })"), {"whole.json:", "values.far_mm is true", "a number"});
  expect_words(refused(R"({ "far_mm": -1 })"), {"whole.json:", "fed_mm is -1", "> 0"});
  expect_words(refused("3"), {"whole.json:", "values is 3", "an object"});
}

TEST(Script, ThoseThatNamedTwinsOfPartsReadTheSameSteps) {
  const auto steps_of = [](const std::string& part) {
    return load_script((fs::path(data_folder()) / "scripts" / "parts" / (part + ".json")).string()).steps;
  };
  const auto pushed_on = steps_of("engage-extra-backup-pushed-on"), pushed = steps_of("engage-extra-backup");
  ASSERT_EQ(pushed_on.size(), pushed.size());
  EXPECT_NEAR(pushed_on[3].unless[1].value, 0.075, 1e-15);
  EXPECT_NEAR(pushed[3].unless[1].value, 0.04, 1e-15);
  EXPECT_EQ(steps_of("wire-another-way-round-guide-turned-in").size(), steps_of("wire-another-way-round").size() + 1);
  EXPECT_EQ(steps_of("balloon-worked-in").size(), steps_of("balloon-filled").size() + 6);
}

TEST(Script, WhatIsWrongInAnotherScriptIsNamedThere) {
  const Folder folder;
  const auto refused = [&](const std::string& part, const std::string& steps) {
    folder.write("parts/up.json", part);
    return refusal_of([&] { read_script((folder.path / "whole.json").string(), whole(steps)); });
  };
  const std::string named = R"({ "do": "script", "script": "parts/up" })";
  std::string bad = wire_part;
  bad.replace(bad.find("12.5"), 4, "-1  ");
  expect_words(refused(bad, named), {"parts/up.json:4:", "speed_mm_s is -1"});
  bad = wire_part;
  bad.replace(bad.find("\"wire\", \"inst"), 6, "\"loop\"");
  expect_words(refused(bad, named), {"whole.json:", "moves a tool \"loop\""});
  expect_words(refused(wire_part, R"({ "do": "script", "script": "parts/down" })"), {"down.json", "cannot be read"});
  expect_words(refused(wire_part, R"({ "do": "script" })"), {"script is missing"});
  bad = wire_part;
  bad.replace(bad.find("{ \"do\": \"wait\""), 0, R"({ "do": "script", "script": "up" }, )");
  expect_words(refused(bad, named), {"deeper than"});
}

TEST(Script, ThoseThatShipLoadAndNameInstrumentsThatThereAre) {
  const std::vector<Instrument> catalogue = load_catalogue();
  for (const Script& script : load_scripts())
    for (const ScriptTool& tool : script.tools) EXPECT_NO_THROW(find_instrument(catalogue, tool.instrument));
  try {
    find_script("no-such-script");
    FAIL();
  } catch (const LoadError& error) {
    expect_words(error.what(), {"no script \"no-such-script\"", "aorta-arch-wire"});
  }
}

}  // namespace
}  // namespace ostium::data
