/// A new design of stent or balloon is one file with a `design` block: its numbers reach the models, omitted ones keep
/// their defaults, and errors are reported with file, place and remedy.
#include "data/catalogue/instrument/instrument_design.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "data/catalogue/catalogue.h"
#include "tests/data/catalogue/instrument_files.h"
#include "tests/data/refusals.h"
#include "vascular/treatment/stent.h"

namespace ostium::data {
namespace {

std::string shipped(const std::string& name) {
  std::ifstream in(std::filesystem::path(data_folder()) / "instruments" / (name + ".json"));
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

/// The shipped 3.0 x 18 mm stent with a design of its own, and one for its balloon.
std::string stent_with(const std::string& design) {
  return with(shipped("stent-30x18"), R"("length_mm": 18,)", R"("length_mm": 18, "design": {)" + design + "},");
}
std::string balloon_with(const std::string& name, const std::string& design) {
  return with(shipped(name), R"("compliance":)", R"("design": {)" + design + R"(}, "compliance":)");
}

std::string said_of(const std::string& name, const std::string& text) {
  try {
    read_instrument("folder/" + name + ".json", text);
  } catch (const LoadError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(InstrumentDesign, WithoutABlockAllIsAsBefore) {
  const Instrument plain = read_instrument("stent-30x18.json", shipped("stent-30x18"));
  const vascular::StentModel stent =
      vascular::make_stent(plain.stent->nominal_m, plain.stent->length_m, plain.stent->design);
  EXPECT_EQ(stent.crowns, 6);
  EXPECT_EQ(stent.rings, 14);
  EXPECT_EQ(stent.links, 3);
  EXPECT_EQ(stent.strut_m, 81e-6);
  EXPECT_EQ(stent.hoop_Pa, 30 * 101325);
  EXPECT_EQ(vascular::make_stent(3.5e-3, 18e-3).crowns, 9);
  EXPECT_FALSE(plain.balloon->own_folds);
  const vascular::BalloonModel balloon = make_balloon(vascular::Compliance::semi, 3e-3, 18.5e-3, plain.balloon->design);
  EXPECT_EQ(balloon.growth_m_Pa, 0.25e-3 / 6 / 101325);
  EXPECT_EQ(balloon.folded_m, 0.45e-3);
}

TEST(InstrumentDesign, ADesignOfOnesOwn) {
  const Instrument made = read_instrument(
      "stent-30x18.json", stent_with(R"("crowns": 8, "rings": 12, "links": 2, "strut_mm": 0.06, "hoop_atm": 24,
      "yield_strain": 0.05, "source": "a test")"));
  const vascular::StentModel stent =
      vascular::make_stent(made.stent->nominal_m, made.stent->length_m, made.stent->design);
  EXPECT_EQ(stent.crowns, 8);
  EXPECT_EQ(stent.rings, 12);
  EXPECT_EQ(stent.links, 2);
  EXPECT_DOUBLE_EQ(stent.strut_m, 60e-6);
  EXPECT_DOUBLE_EQ(stent.hoop_Pa, 24 * 101325);
  EXPECT_EQ(stent.yield, 0.05);
  EXPECT_EQ(stent.crush_N, 0.5);
  EXPECT_EQ(stent.points(), 12 * 2 * 8);
  bool source = false;
  for (const Source& s : made.sources) source = source || (s.of == "stent.design" && s.citation == "a test");
  EXPECT_TRUE(source);
}

TEST(InstrumentDesign, ABalloonsChartAndFolds) {
  const Instrument made =
      read_instrument("balloon-nc-30x12.json", balloon_with("balloon-nc-30x12", R"("growth_mm_per_atm": 0.02,
      "folded_radius_mm": 0.48, "refolded_radius_mm": 0.6, "source": "a test")"));
  EXPECT_TRUE(made.balloon->own_folds);
  const vascular::BalloonModel balloon = make_balloon(vascular::Compliance::non, 3e-3, 12e-3, made.balloon->design);
  EXPECT_NEAR(chart_diameter_m(balloon, 20 * 101325) - chart_diameter_m(balloon, 10 * 101325), 0.2e-3, 1e-12);
  EXPECT_DOUBLE_EQ(balloon.folded_m, 0.48e-3);
  EXPECT_DOUBLE_EQ(balloon.refolded_m, 0.6e-3);
}

TEST(InstrumentDesign, EveryNumberOfATableReachesItsMember) {
  for (const DesignNumber<vascular::StentDesign>& row : stent_design_numbers) {
    const double value = (row.least + row.most) / 2;
    const Instrument made = read_instrument(
        "stent-30x18.json", stent_with("\"" + row.key + "\": " + std::to_string(value) + R"(, "source": "a test")"));
    EXPECT_NEAR(made.stent->design.*row.member / row.unit, value, 1e-6 * row.most) << row.key;
  }
  for (const DesignNumber<vascular::BalloonDesign>& row : balloon_design_numbers) {
    const double value = (row.least + row.most) / 2;
    std::string text = "\"" + row.key + "\": " + std::to_string(value);
    if (row.key == "folded_radius_mm") text += R"(, "refolded_radius_mm": 1.5)";
    if (row.key == "refolded_radius_mm") text += R"(, "folded_radius_mm": 1.0)";
    const Instrument made =
        read_instrument("balloon-25x15.json", balloon_with("balloon-25x15", text + R"(, "source": "a test")"));
    EXPECT_NEAR(made.balloon->design.*row.member / row.unit, value, 1e-6 * row.most) << row.key;
  }
}

TEST(InstrumentDesign, WhatIsWrongIsSaidWithItsCure) {
  expect_words(said_of("stent-30x18", stent_with(R"("crowns": 8)")),
               {"folder/stent-30x18.json:", "stent.design.source is missing"});
  expect_words(said_of("stent-30x18", stent_with(R"("crowns": 8.5, "source": "a test")")),
               {"folder/stent-30x18.json:", "stent.design.crowns is 8.5", "3 to 24"});
  expect_words(said_of("stent-30x18", stent_with(R"("strut_mm": 3, "source": "a test")")),
               {"folder/stent-30x18.json:", "stent.design.strut_mm is 3", "0.03 to 0.3"});
  expect_words(said_of("stent-30x18", stent_with(R"("crowns": 8, "source": "a test")")),
               {"folder/stent-30x18.json:", "stent.design", "links that divide the crowns"});
  expect_words(said_of("stent-30x18", stent_with(R"("struts": 8, "source": "a test")")),
               {"folder/stent-30x18.json:", "stent.design.struts is not a key", "strut_mm"});
  expect_words(
      said_of("balloon-25x15", balloon_with("balloon-25x15", R"("folded_radius_mm": 0.5, "source": "a test")")),
      {"folder/balloon-25x15.json:", "balloon.design", "expected both"});
}

}  // namespace
}  // namespace ostium::data
