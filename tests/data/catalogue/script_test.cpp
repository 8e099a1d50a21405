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

std::string script_refusal(const std::string& from, const std::string& to) {
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

/// But those of the catalogue are found by it.
TEST(Script, MayBeCalledOtherwiseThanItsFile) {
  EXPECT_EQ(read_script("folder/copy-2.json", small_script).name, "small");
  for (const Script& script : load_scripts()) EXPECT_EQ(fs::path(script.file).stem(), script.name);
}

TEST(Script, AMarkHasATextOrALabel) {
  const std::string view = "{ \"do\": \"view\", \"view\": \"spider\" }";
  EXPECT_EQ(script_refusal(view, R"({ "do": "mark", "label": "here" })"), "accepted");
  EXPECT_EQ(script_refusal(view, R"({ "do": "mark", "text": "here" })"), "accepted");
  expect_words(script_refusal(view, R"({ "do": "mark" })"), {"small.json:7:", "expected text or label"});
}

TEST(Script, MistakesAreNamedByLine) {
  expect_words(script_refusal("\"speed_mm_s\"", "\"speed_mms\""),
               {"folder/small.json:8:", "speed_mms is not a key of the step"});
  expect_words(script_refusal("\"tip_passes\"", "\"tip_pases\""),
               {"folder/small.json:9:", "tip_pases is not a key of the condition"});
  expect_words(script_refusal("\"tool\": \"wire\"", "\"tool\": \"wyre\""),
               {"small.json:8:", "one of the script's tools: guide, wire"});
  expect_words(script_refusal("\"speed_mm_s\": 50,", ""),
               {"small.json:8:", "speed_mm_s is missing", "\"advance\" needs it"});
  expect_words(script_refusal("\"speed_mm_s\": 50", "\"speed_mm_s\": -50"), {"small.json:8:", "is -50", "> 0"});
  expect_words(script_refusal("\"do\": \"advance\"", "\"do\": \"push\""), {"small.json:8:", "advance, withdraw, turn"});
  expect_words(script_refusal("\"view\": \"spider\"", "\"view\": \"spyder\""), {"small.json:7:", "ostium views"});
  EXPECT_EQ(script_refusal("\"view\": \"spider\"", "\"table_mm\": [-1000, 0, 1000]"), "accepted");
  expect_words(script_refusal("\"view\": \"spider\"", "\"table_mm\": [1e9, 0, 0]"),
               {"small.json:7:", "table_mm", "three numbers from -1000 to 1000"});
  expect_words(script_refusal("\"view\": \"spider\"", "\"view\": \"spider\", \"on\": true"),
               {"small.json:7:", "no meaning for \"view\""});
  expect_words(script_refusal("\"view\": \"spider\"", "\"view\": \"spider\", \"lao_deg\": 3"),
               {"small.json:7:", "says two views"});
  expect_words(script_refusal(", \"view\": \"spider\"", ""), {"small.json:7:", "moves nothing"});
  expect_words(script_refusal("[\"guide\", \"wire\"]", "[\"wire\", \"wire\"]"),
               {"small.json:10:", "tool[1]", "there twice"});
  const std::string place = R"({ "name": "here", "at_mm": [0, 0, 0] })";
  expect_words(script_refusal("\"steps\"", "\"landmarks\": [" + place + ", " + place + "], \"steps\""),
               {"landmarks[1].name", "another landmark"});
  expect_words(script_refusal(R"("view", "view": "spider")", R"("provoke", "complication": "VF", "air_mL": 1)"),
               {"small.json:7:", "air_mL has no meaning for VF"});
  expect_words(script_refusal("\"otherwise\": \"up\"", "\"otherwise\": \"down\""),
               {"small.json:11:", "the label of a step"});
  expect_words(script_refusal("\"tries\": 2", "\"tries\": 0"), {"small.json:11:", "1 to 100"});
  expect_words(script_refusal("\"otherwise\": \"up\", \"tries\": 2", "\"last_resort\": \"up\""),
               {"small.json:11:", "beside otherwise"});
  EXPECT_EQ(script_refusal("\"tries\": 2", "\"last_resort\": \"up\""), "accepted") << "once, then there";
  expect_words(script_refusal("\"tries\": 2", "\"tries\": 2, \"last_resort\": \"down\""),
               {"small.json:11:", "the label of a step"});
  EXPECT_EQ(script_refusal("\"label\": \"up\"", "\"label\": \"up\", \"detour\": true"), "accepted");
  expect_words(script_refusal("\"label\": \"up\"", "\"label\": \"up\", \"detour\": 1"), {"small.json:8:", "true"});
  expect_words(script_refusal("\"view\": \"spider\"", "\"view\": \"spider\", \"detour\": true"),
               {"small.json:7:", "Not the first step"});
  expect_words(script_refusal("\"do\": \"wait\"", "\"do\": \"wait\", \"label\": \"on\", \"detour\": true"),
               {"small.json:12:", "no step leads to", "wait (on)", "otherwise"});
  expect_words(script_refusal("\"otherwise\": \"up\", \"tries\": 2", "\"detour\": true, \"otherwise\": \"up\""),
               {"small.json:10:", "no step leads to", "turn"});
  expect_words(script_refusal(", \"within_deg\": 20", ""), {"small.json:12:", "within_deg is missing"});
  expect_words(script_refusal("\"tip_points\": \"left\", \"within_deg\": 20", "\"tip_faces\": \"RCA\""),
               {"small.json:12:", "within_deg is missing"});
  EXPECT_EQ(script_refusal("\"tip_points\": \"left\"", "\"tip_faces\": \"RCA\""), "accepted");
  const std::string points = "\"tip_points\": \"left\", \"within_deg\": 20";
  EXPECT_EQ(script_refusal(points, "\"tip_on\": \"LAD\""), "accepted");
  EXPECT_EQ(script_refusal(points, "\"tip_astray\": \"LAD\", \"by_mm\": 5"), "accepted");
  const std::string of_wire = points + ", \"of\": \"wire\"";
  EXPECT_EQ(script_refusal(of_wire, "\"distal_marker_at\": \"D1\", \"beyond_mm\": -0.5"), "accepted");
  expect_words(script_refusal(of_wire, "\"distal_marker_at\": \"D1\""), {"small.json:12:", "beyond_mm is missing"});
  expect_words(script_refusal(points, "\"tip_astray\": \"LAD\""), {"small.json:12:", "by_mm is missing"});
  expect_words(script_refusal(points, "\"tip_on\": \"LAD\", \"by_mm\": 5"), {"small.json:12:", "by_mm"});
  expect_words(script_refusal("{ \"seconds\": 3 }", "{ \"seconds\": 3, \"beats\": 2 }"),
               {"small.json:10:", "both seconds and beats"});
  expect_words(script_refusal("{ \"seconds\": 3 }", "{ \"seconds\": 3, \"of\": \"wire\" }"),
               {"small.json:10:", ".of has no meaning beside seconds"});
  expect_words(script_refusal("{ \"seconds\": 3 }", "{ }"), {"small.json:10:", "says nothing to look at"});
  expect_words(script_refusal("\"label\": \"up\"", "\"label\": \"up\", \"timeout_s\": 0"), {"small.json:"});
  expect_words(script_refusal("{ \"name\": \"wire\"", "{ \"name\": \"guide\""),
               {"small.json:5:", "another tool of that name"});
  expect_words(script_refusal("\"until\": [{ \"tip_passes\": \"arch\" }],", "\"until\": [],"),
               {"small.json:9:", "a list of conditions"});
  expect_words(script_refusal(", \"of\": \"wire\"", ""), {"small.json:12:", "does not say of which tool"});
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
