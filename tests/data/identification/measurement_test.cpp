/// Measured sets: correct reading, and errors reported by entry.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "data/catalogue/catalogue.h"
#include "data/identification/effects/effect_list.h"
#include "data/identification/measurement/measurement_keys.h"
#include "data/identification/measurement/measurement_reader.h"
#include "tests/data/refusals.h"
#include "tests/support/sets/synthetic_set.h"

namespace ostium::data {
namespace {

using Json = nlohmann::ordered_json;

Json good() { return Json::parse(synthetic::to_json(synthetic::two_tubes(4))); }

std::string set_refusal(const Json& file) {
  try {
    read_measurement("set/measurement.json", file.dump(1));
  } catch (const LoadError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Measurement, TheSetItselfIsFineAndRead) {
  const Json file = good();
  EXPECT_EQ(set_refusal(file), "accepted");
  const MeasurementSet set = read_measurement("m.json", file.dump());
  ASSERT_EQ(set.instruments.size(), 2u);
  EXPECT_NEAR(set.instruments[0].sections[0].EI1_N_m2, 5500e-6, 1e-12);
  EXPECT_NEAR(set.instruments[0].sections[0].rest_curvature_per_m.y(), 13.6, 1e-9);
  EXPECT_NEAR(set.instruments[1].sections[1].kg_per_m, 2e-3, 1e-12);
  EXPECT_NEAR(*set.imaging.noise_sigma_m, 0.3e-3, 1e-12);
  EXPECT_TRUE(set.imaging.registration_free);
  EXPECT_EQ(set.experiments[2].kind, Experiment::Kind::tip);
  EXPECT_NEAR(set.experiments[2].set[0].shaft_m + set.experiments[2].set[0].inserted_m, 0.14, 1e-12);
}

/// At the base d3 = tangent, d1 = up made orthogonal to it, d2 = d3 x d1.
TEST(Measurement, TheBaseFrameIsThatOfTheFormat) {
  Json file = good();
  file["experiments"][0]["base"] = {{"position_mm", {1, 2, 3}}, {"tangent", {0, 2, 0}}, {"up", {3, 5, 0}}};
  const core::EndState base = read_measurement("m.json", file.dump()).experiments[0].base;
  const Eigen::Matrix3d R = Eigen::Quaterniond(base.q_W[0], base.q_W[1], base.q_W[2], base.q_W[3]).matrix();
  EXPECT_LT((R.col(0) - Eigen::Vector3d::UnitX()).norm(), 1e-12);
  EXPECT_LT((R.col(1) + Eigen::Vector3d::UnitZ()).norm(), 1e-12);
  EXPECT_LT((R.col(2) - Eigen::Vector3d::UnitY()).norm(), 1e-12);
  EXPECT_LT((base.p_W - Eigen::Vector3d(1e-3, 2e-3, 3e-3)).norm(), 1e-15);
}

TEST(Measurement, TheExactEntryIsNamed) {
  Json file = good();
  file["experiments"][3].erase("tip_mm");
  file["experiments"][3]["centreline_mm"] = Json::array();
  for (int i = 0; i < 18; ++i) file["experiments"][3]["centreline_mm"].push_back({0, 0, i});
  file["experiments"][3]["centreline_mm"][17] = {1, 2};
  expect_words(set_refusal(file),
               {"set/measurement.json:", "experiments[3].centreline_mm[17]", "expected 3 numbers, got 2"});
  file["experiments"][3]["centreline_mm"][17] = {1, 2, "3"};
  expect_words(set_refusal(file), {"experiments[3].centreline_mm[17][2] is \"3\"", "a number"});
  file["experiments"][3]["centreline_mm"] = {{0, 0, 0}};
  expect_words(set_refusal(file), {"experiments[3].centreline_mm is", "at least two points"});
}

TEST(Measurement, KeysUnknownMissingOrTooMany) {
  Json file = good();
  file["experiments"][1]["inserted"] = 3;
  expect_words(set_refusal(file), {"experiments[1].inserted is not a key of the experiment"});
  file = good();
  file["experiments"][1]["set"][1].erase("roll_deg");
  expect_words(set_refusal(file), {"experiments[1].set[1].roll_deg is missing", "degrees"});
  file = good();
  file["experiments"][1]["radius_of_curvature_mm"] = 100;
  expect_words(set_refusal(file), {"experiments[1] has 2 of centreline_mm", "exactly one"});
  file["experiments"][1].erase("radius_of_curvature_mm");
  file["experiments"][1].erase("tip_mm");
  expect_words(set_refusal(file), {"experiments[1] has 0 of centreline_mm"});
  file = good();
  file["experiments"][2]["id"] = "p0";
  expect_words(set_refusal(file), {"experiments[2].id is \"p0\"", "no other experiment", "experiments[0]"});
  file = good();
  file["schema"] = "ostium-measurement/2";
  expect_words(set_refusal(file), {"schema is", "ostium-measurement/1"});
  file["schema"] = "ostium-measurement/3", file["kind"] = "push_pull";
  expect_words(set_refusal(file), {"schema is \"ostium-measurement/3\"", "\"ostium-measurement/2\" with a kind"});
  file = good();
  file["experiments"][0]["set"].erase(1);
  expect_words(set_refusal(file), {"experiments[0].set is", "one entry for each of 2 instruments, got 1"});
}

TEST(Measurement, WhatCannotBeIsRefused) {
  const auto with = [](const char* pointer, const Json& value) {
    Json file = good();
    file[Json::json_pointer(pointer)] = value;
    return set_refusal(file);
  };
  expect_words(with("/experiments/1/base/tangent", {0, 0, 0}),
               {"experiments[1].base.tangent is [0, 0, 0]", "not all zero"});
  expect_words(with("/experiments/1/base/up", {0, 0, 2}), {"experiments[1].base.up is", "not along the tangent"});
  expect_words(with("/experiments/1/set/0/inserted_length_mm", 141),
               {"experiments[1].set[0].inserted_length_mm is 141", "at most 140 mm", "outer"});
  expect_words(with("/experiments/1/set/0/inserted_length_mm", 0),
               {"experiments[1].set[0].inserted_length_mm is 0", "> 0"});
  expect_words(with("/experiments/1/set/0/shaft_mm", 139), {"experiments[1].set[0].shaft_mm is 139", "not inserted"});
  expect_words(with("/experiments/1/elapsed_s", -1), {"experiments[1].elapsed_s is -1"});
  expect_words(with("/instruments/0/sections/1/from_tip_mm", {60, 140}),
               {"instruments[0].sections[1].from_tip_mm", "begin at 50 mm"});
  expect_words(with("/instruments/0/sections/1/from_tip_mm", {50, 130}), {"instruments[0].sections end 130 mm"});
  expect_words(with("/instruments/1/sections/0/EI_Nmm2", 0), {"instruments[1].sections[0].EI_Nmm2 is 0", "> 0"});
  expect_words(with("/instruments/1/outer_radius_mm", 1.5),
               {"instruments[1].outer_radius_mm is 1.5", "at most 1.4 mm", "lumen"});
  expect_words(with("/imaging/noise_sigma_mm", 0), {"imaging.noise_sigma_mm is 0", "null if it is unknown"});
  expect_words(with("/imaging/registration", "fixed"), {"imaging.registration is \"fixed\"", "given, free"});
  expect_words(with("/experiments", Json::array()), {"experiments is []", "not empty"});
  Json file = good();
  file["experiments"][0]["set"][0] = {{"inserted_length_mm", 120}, {"roll_deg", 0}};
  file["experiments"][0]["set"][1] = {{"inserted_length_mm", 80}, {"roll_deg", 0}};
  file["experiments"][0]["tip_force_N"] = {0, 0, 0.1};
  expect_words(set_refusal(file), {"experiments[0].tip_force_N", "inside another instrument"});
}

TEST(Measurement, EffectsAreCheckedAgainstWhatThereIs) {
  const auto refused = [](const Json& effect) -> std::string {
    Json file = good();
    file["effects"] = {effect};
    try {
      declared_effects(read_measurement("set/measurement.json", file.dump(1)));
    } catch (const LoadError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(refused({{"id", "shaft_torsion"}, {"instrument", 1}, {"parameters", {{"compliance", 2}}}}), "accepted");
  expect_words(refused({{"id", "shaft_tension"}, {"parameters", Json::object()}}),
               {"effects[0].id is \"shaft_tension\"", "shaft_torsion"});
  expect_words(refused({{"id", "shaft_torsion"}, {"parameters", {{"give", 2}}}}),
               {"effects[0].parameters.give", "compliance"});
  expect_words(refused({{"id", "shaft_torsion"}, {"parameters", {{"compliance", -2}}}}),
               {"effects[0].parameters.compliance is -2", "0 to 10"});
  expect_words(refused({{"id", "shaft_torsion"}, {"instrument", 2}, {"parameters", Json::object()}}),
               {"effects[0].instrument is 2", "0 to 1"});
  expect_words(refused({{"id", "stress_relaxation"}, {"parameters", Json::object()}}), {"effects[0]", "elapsed_s"});
}

TEST(Measurement, SchemaOfEffectsHasTheirRanges) {
  const auto schema_of = [](const std::string& name) {
    return nlohmann::json::parse(
        std::ifstream(std::filesystem::path(data_folder()) / "schemas" / (name + ".schema.json")));
  };
  const auto ranges = schema_of("effects")["$defs"];
  EXPECT_EQ(ranges.size(), effects().size());
  for (const Effect& effect : effects()) {
    ASSERT_TRUE(ranges.contains(effect.id)) << effect.id;
    EXPECT_EQ(ranges[effect.id]["properties"].size(), effect.parameters.size());
    for (const EffectParameter& p : effect.parameters) {
      const auto& property = ranges[effect.id]["properties"][p.name];
      EXPECT_EQ(property["minimum"], p.least) << p.name;
      EXPECT_EQ(property["maximum"], p.most) << p.name;
      EXPECT_EQ(property["default"], p.prior) << p.name;
    }
  }
}

}  // namespace
}  // namespace ostium::data
