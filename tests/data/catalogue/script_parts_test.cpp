/// Scripts that stand in other scripts: their tools, values, labels, and where a mistake is named.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "data/catalogue/catalogue.h"
#include "data/catalogue/script/script.h"
#include "tests/data/refusals.h"

namespace ostium::data {
namespace {

namespace fs = std::filesystem;

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

TEST(ScriptParts, StepsOfAnotherScriptStandWhereItIsNamed) {
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

TEST(ScriptParts, AnotherScriptMayStandTwiceWithOtherToolsAtAnotherLesion) {
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

TEST(ScriptParts, StepsOfAnotherScriptLeadToTheLabelBesideItWhereTheRunWouldEnd) {
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

TEST(ScriptParts, ValuesOfAnotherScriptMayBeSaidAnew) {
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

TEST(ScriptParts, ThoseThatNamedTwinsOfPartsReadTheSameSteps) {
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

TEST(ScriptParts, WhatIsWrongInAnotherScriptIsNamedThere) {
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

TEST(ScriptParts, PartsOfPartsAreCounted) {
  const Folder folder;
  const auto named = [](const std::string& name, const std::string& step, int times) {
    std::string steps;
    for (int i = 0; i < times; ++i) steps += (i ? ", " : "") + step;
    return R"({ "schema": "ostium-script/1", "name": ")" + name +
           R"(", "title": "A part", "tools": [ { "name": "wire", "instrument": "cook-j" } ], "steps": [)" + steps +
           "] }";
  };
  const auto refusal = [&] { return refusal_of([&] { load_script((folder.path / "whole.json").string()); }); };
  folder.write("some.json", named("some", R"({ "do": "wait", "until": [{ "seconds": 1 }] })", 200));
  folder.write("whole.json", named("whole", R"({ "do": "script", "script": "some" })", 51));
  expect_words(refusal(), {"whole.json:1: steps[20]", "more than 4000 steps"});
  folder.write("whole.json", named("whole", R"({ "do": "mark" })", 4001));
  expect_words(refusal(), {"whole.json:1: steps[4000]", "more than 4000 steps"});
  // 32 x 32 parts, the innermost of one step.
  folder.write("one.json", named("one", R"({ "do": "wait", "until": [{ "seconds": 1 }] })", 1));
  folder.write("many.json", named("many", R"({ "do": "script", "script": "one" })", 32));
  folder.write("whole.json", named("whole", R"({ "do": "script", "script": "many" })", 32));
  expect_words(refusal(), {"many.json:1: steps[", "more than 1000 parts"});
}

}  // namespace
}  // namespace ostium::data
