/// Errors in an instrument file are reported: file, line, key, value found, what was expected.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "data/catalogue/catalogue.h"
#include "tests/data/catalogue/instrument_files.h"
#include "tests/data/refusals.h"

namespace ostium::data {
namespace {

TEST(InstrumentErrors, TheSmallCatheterItselfIsFine) { EXPECT_EQ(refusal(small_catheter), "accepted"); }

TEST(InstrumentErrors, NoJson) {
  expect_words(refusal(R"("title": "A hook",)", R"("title": "A hook")"),
               {"folder/hook.json:5: is not JSON", "expected"});
  expect_words(refusal(small_catheter.substr(0, 300)), {"folder/hook.json:", "not JSON"});
  expect_words(refusal(""), {"folder/hook.json:1: is not JSON"});
  expect_words(refusal("[1, 2]"), {"folder/hook.json:1:", "the file is [1, 2]", "expected an object"});
  expect_words(refusal(std::string(100, '[')), {"nests deeper than 32"});
  EXPECT_THROW(load_instrument("/nowhere/hook.json"), LoadError);
  EXPECT_THROW(load_instrument("/"), LoadError);
}

TEST(InstrumentErrors, RelaxationIsLessThanAll) {
  const std::string end = R"(    ],
    "source": "a test"
  },
  "shape")";
  const auto relaxing = [&](const std::string& branches) {
    return with(small_catheter, end, R"(    ], "relaxation": [)" + branches + R"(], "source": "a test"
  },
  "shape")");
  };
  const Instrument read = read_instrument("hook.json", relaxing(R"({ "fraction": 0.2, "time_s": 60 })"));
  EXPECT_EQ(read.relaxation.branches[0].fraction, 0.2);
  EXPECT_EQ(read.relaxation.branches[0].time_s, 60);
  EXPECT_EQ(read.relaxation.branches[1].fraction, 0);
  expect_words(refusal(relaxing(R"({ "fraction": 0.5, "time_s": 60 }, { "fraction": 0.5, "time_s": 600 })")),
               {"sections.relaxation[1].fraction is 0.5", "less than 1 in all"});
  expect_words(refusal(relaxing("")), {"sections.relaxation", "one or two branches"});
  expect_words(refusal(relaxing(R"({ "fraction": 0.5 })")), {"sections.relaxation[0].time_s is missing"});
}

TEST(InstrumentErrors, KeysUnknownMissingOrTwice) {
  expect_words(refusal(R"("GJ_Nmm2": 20)", R"("GJ_Nmm": 20)"),
               {"folder/hook.json:12:", "sections.list[0].GJ_Nmm is not a key of the section", "one of", "GJ_Nmm2"});
  expect_words(refusal(R"("GJ_Nmm2": 250, )", ""),
               {"folder/hook.json:13:", "sections.list[1].GJ_Nmm2 is missing", "torsional stiffness in N mm2, > 0"});
  expect_words(refusal(R"(  "title": "A hook",)", ""), {"folder/hook.json:1: title is missing"});
  expect_words(refusal(R"("GJ_Nmm2": 20)", R"("GJ_Nmm2": 20, "GJ_Nmm2": 21)"),
               {"folder/hook.json:12:", "sections.list[0].GJ_Nmm2", "twice"});
}

TEST(InstrumentErrors, WrongTypes) {
  expect_words(refusal(R"("length_mm": 1000)", R"("length_mm": "1000")"),
               {"folder/hook.json:7:", "size.length_mm is \"1000\"", "expected the usable length in mm, > 0"});
  expect_words(refusal("[40, 1000]", "[40]"), {"folder/hook.json:13:", "from_tip_mm is [40]", "two distances"});
  expect_words(refusal("[40, 1000]", "[40, null]"), {"from_tip_mm is [40, null]"});
  expect_words(refusal(R"("title": "A hook")", R"("title": "")"), {"folder/hook.json:4: title is \"\""});
  expect_words(refusal("\"guide_catheter\"", "\"hose\""),
               {"folder/hook.json:5: kind is \"hose\"; expected one of wire, guide_catheter"});
  expect_words(refusal("\"gold\"", "\"brass\""),
               {"folder/hook.json:30: markers.list[0].material is \"brass\"", "platinum"});
  expect_words(refusal("\"ostium-instrument/1\"", "\"ostium-instrument/2\""), {":2: schema is", "ostium-instrument/1"});
  expect_words(refusal("\"name\": \"hook\"", "\"name\": \"crook\""), {":3: name is \"crook\"", "file's name"});
}

TEST(InstrumentErrors, WhatNoMatterIsMadeOf) {
  // A tube of 2 and 1.8 mm has a second moment of 0.270 mm4: of diamond, 325,000 N mm2.
  EXPECT_EQ(refusal("\"EI_Nmm2\": 30,", "\"EI_Nmm2\": 3e5,"), "accepted");
  expect_words(refusal("\"EI_Nmm2\": 30,", "\"EI_Nmm2\": 4e5,"), {"EI_Nmm2 is", "at most diamond's"});
  // A tube of 2 and 1.8 mm has 0.597 mm2: of osmium 0.0135 kg/m.
  EXPECT_EQ(refusal(R"("kg_per_m": 0.001)", R"("kg_per_m": 0.0134)"), "accepted");
  expect_words(refusal(R"("kg_per_m": 0.001)", R"("kg_per_m": 0.0136)"), {"sections.list[0].kg_per_m is 0.0136"});
  expect_words(refusal(R"("kg_per_m": 0.001)", R"("kg_per_m": 1)"), {"at most osmium's in its cross-section"});
  expect_words(refusal(R"("thickness_mm": 0.05)", R"("thickness_mm": 1.58)"),
               {"radiopacity.list[0].thickness_mm is 1.58", "at most pi/4"});
  expect_words(refusal(R"("thickness_mm": 0.05)", R"("thickness_mm": 1e300)"), {"at most pi/4"});
  expect_words(refusal(R"("radius_mm": 20)", R"("radius_mm": 1e-300)"), {"at least half the outer diameter"});
  expect_words(refusal(R"("plane_deg": 0)", R"("plane_deg": -1e300)"), {"-360 to 360"});
}

TEST(InstrumentErrors, TheLineIsThatOfTheValueWhereverItStands) {
  // After a number at the end of its line, before its comma, the parser has already read ahead.
  expect_words(refusal(R"("EI_Nmm2": 30,)", "\"EI_Nmm2\":\n  -30\n,"),
               {"folder/hook.json:13: sections.list[0].EI_Nmm2 is -30"});
  expect_words(refusal(R"("GJ_Nmm2": 20,)", "\"GJ_Nmm2\": \n\n\n 0,"),
               {"folder/hook.json:15: sections.list[0].GJ_Nmm2 is 0"});
}

TEST(InstrumentErrors, GapsAndOverlaps) {
  expect_words(refusal("[40, 1000]", "[50, 1000]"),
               {"folder/hook.json:13: sections.list[1].from_tip_mm is [50, 1000]", "begin at 40 mm", "no gap"});
  expect_words(refusal("[40, 1000]", "[30, 1000]"), {"is [30, 1000]", "begin at 40 mm", "no overlap"});
  expect_words(refusal("[0, 40]", "[1, 40]"), {"folder/hook.json:12:", "begin at 0 mm"});
  expect_words(refusal("[40, 1000]", "[40, 30]"), {"is [40, 30]", "from < to"});
  expect_words(refusal("[40, 1000]", "[40, 900]"), {"folder/hook.json:11: sections.list ends 900 mm", "1000 mm"});
  expect_words(refusal("[40, 1000]", "[40, 1100]"), {"is [40, 1100]", "<= length"});
  expect_words(refusal("[0, 1000]", "[0, 500]"), {"folder/hook.json:25: radiopacity.list ends 500 mm"});
}

TEST(InstrumentErrors, NumbersThatCannotBe) {
  expect_words(refusal(R"("EI1_Nmm2": 300)", R"("EI1_Nmm2": -300)"),
               {"folder/hook.json:13: sections.list[1].EI1_Nmm2 is -300", "> 0"});
  expect_words(refusal(R"("EI_Nmm2": 30)", R"("EI_Nmm2": 0)"), {"folder/hook.json:12: sections.list[0].EI_Nmm2 is 0"});
  expect_words(refusal(R"("EI2_Nmm2": 200, )", ""), {"folder/hook.json:13:", "both EI1_Nmm2 and EI2_Nmm2"});
  expect_words(refusal(R"("EI_Nmm2": 30, )", ""), {"folder/hook.json:12:", "has 0 of the bending stiffnesses"});
  expect_words(refusal(R"("kg_per_m": 0.001)", R"("kg_per_m": 0)"), {"kg_per_m is 0", "weight in kg/m, > 0"});
  expect_words(refusal(R"("inner_diameter_mm": 1.8)", R"("inner_diameter_mm": 2)"),
               {"folder/hook.json:7: size.inner_diameter_mm is 2", "less than the outer one"});
  expect_words(refusal(R"("inner_diameter_mm": 1.8)", R"("inner_diameter_mm": 0)"), {"size.inner_diameter_mm is 0"});
  expect_words(refusal(R"("from_tip_mm": 5)", R"("from_tip_mm": 999.5)"),
               {"folder/hook.json:30: markers.list[0].from_tip_mm is 999.5", "within the instrument's 1000 mm"});
  const auto band = [](const std::string& more) {
    return refusal(R"("material": "gold", "thickness_mm": 0.1)", R"("material": "gold", "thickness_mm": 0.1, )" + more);
  };
  EXPECT_EQ(band(R"("outer_diameter_mm": 1)"), "accepted");
  expect_words(band(R"("outer_diameter_mm": 3)"),
               {"folder/hook.json:30: markers.list[0].outer_diameter_mm is 3", "at most the instrument's 2 mm"});
  expect_words(band(R"("outer_diameter_mm": 0.1)"), {":30: markers.list[0].thickness_mm is 0.1", "pi/4"});
  expect_words(refusal(R"("passes_mm": 1.75)", R"("passes_mm": 1.9)"),
               {":35: clearance.passes_mm is 1.9", "inner diameter"});
  expect_words(refusal(R"("passes_mm": 1.75, )", ""), {":34: clearance has no number"});
  expect_words(refusal(R"("radius_mm": 20, )", ""), {":20: shape.pieces[1].plane_deg is 0", "together with radius_mm"});
  expect_words(refusal(R"("length_mm": 10 )", R"("length_mm": 1000 )"), {":18: shape.pieces is", "not longer"});
}

TEST(InstrumentErrors, WhatCoreDoesNotTakeIsRefusedHereToo) {
  expect_words(refusal(R"("EI_Nmm2": 30,)", R"("EI_Nmm2": 1e-7,)"),
               {"folder/hook.json:10: sections make no rod", "EI1"});
}

TEST(InstrumentErrors, EveryGroupOfNumbersNeedsItsSource) {
  // Each group in turn loses its source (the keys are in alphabetical order here, so lines are not checked).
  const auto whole = nlohmann::json::parse(small_catheter);
  for (const char* group : {"size", "sections", "shape", "radiopacity", "markers", "clearance"}) {
    auto spoilt = whole;
    spoilt[group].erase("source");
    expect_words(refusal(spoilt.dump(1)), {group, ".source is missing", "a citation"});
    spoilt[group]["source"] = "";
    expect_words(refusal(spoilt.dump(1)), {group, ".source is \"\""});
    spoilt[group]["source"] = "estimate: ";
    expect_words(refusal(spoilt.dump(1)), {group, ".source is \"estimate: \"", "the reasoning in at least 10"});
  }
}

TEST(InstrumentErrors, GroupsThatDoNotGoTogether) {
  expect_words(refusal("\"guide_catheter\"", "\"stent_shaft\""), {":5: kind is \"stent_shaft\"", "wire_lumen"});
  expect_words(refusal("  \"clearance\": {", R"(  "wire_lumen": { "system": "over_the_wire", "source": "a test" },
  "clearance": {)"),
               {":34: wire_lumen is {...}", "for balloon_shaft and stent_shaft"});
  expect_words(refusal(R"("GJ_Nmm2": 20,)", R"("GJ_Nmm2": 20, "rest_curvature_per_mm": [0, 0.1, 0],)"),
               {":17: shape is {...}", "only without rest_curvature_per_mm"});
  expect_words(refusal("\"shape\": {", "\"shapeable_tip\": { \"length_mm\": 50,"),
               {":17: shapeable_tip is", "wires only"});
  expect_words(
      refusal("  \"clearance\": {", R"(  "stent": { "nominal_diameter_mm": 3, "length_mm": 18, "source": "a test" },
  "clearance": {)"),
      {":34: stent is {...}", "for stent_shaft"});
}

TEST(InstrumentErrors, ABalloonLiesBetweenItsMarkers) {
  std::ifstream in(std::filesystem::path(data_folder()) / "instruments" / "stent-30x18.json");
  const std::string whole{std::istreambuf_iterator<char>(in), {}};
  const auto spoilt = [&](const std::string& from, const std::string& to) {
    std::string text = whole;
    EXPECT_NE(text.find(from), std::string::npos) << from;
    text.replace(text.find(from), from.size(), to);
    try {
      read_instrument("stent-30x18.json", text);
    } catch (const LoadError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  expect_words(spoilt("\"length_mm\": 19", "\"length_mm\": 25"), {"balloon.length_mm is 25", "as the markers say"});
  expect_words(spoilt("\"rated_atm\": 16", "\"rated_atm\": 6"), {"balloon.rated_atm is 6", "at least the nominal one"});
  expect_words(spoilt("\"length_mm\": 18", "\"length_mm\": 24"),
               {"stent.length_mm is 24", "at most that of its balloon"});
  expect_words(spoilt("\"compliance\": \"semi\"", "\"compliance\": \"very\""), {"compliance", "semi, non"});
}

}  // namespace
}  // namespace ostium::data
