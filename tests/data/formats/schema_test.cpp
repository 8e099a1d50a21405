/// Schemas are generated from the readers' tables of keys.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "data/catalogue/catalogue.h"
#include "tests/data/formats/schema_files.h"

namespace ostium::data {
namespace {

TEST(Schemas, AreWhatTheReadersTablesMake) {
  for (const JsonFormat& format : json_formats()) {
    std::stringstream text;
    text << std::ifstream(std::filesystem::path(data_folder()) / "schemas" / schema_file(format)).rdbuf();
    EXPECT_EQ(text.str(), schema_text(format))
        << schema_file(format) << " is stale: cmake --build build --target write_schemas && "
        << "build/tests/tools/write_schemas data/schemas";
  }
}

TEST(Schemas, HaveAnObjectForEveryReference) {
  for (const JsonFormat& format : json_formats()) {
    const auto schema = nlohmann::json::parse(schema_text(format));
    const std::string text = schema.dump(), mark = "\"#/$defs/";
    for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + 1)) {
      const std::size_t from = at + mark.size();
      EXPECT_TRUE(schema["$defs"].contains(text.substr(from, text.find('"', from) - from))) << text.substr(from, 40);
    }
  }
}

TEST(Schemas, LetAValuesNameStandForANumberInAStepAndNowhereElse) {
  const auto defs = nlohmann::json::parse(schema_text(json_formats().front()))["$defs"];
  const auto& speed = defs["step"]["properties"]["speed_mm_s"]["oneOf"];
  EXPECT_EQ(speed[0]["maximum"], 500);
  EXPECT_EQ(speed[1]["pattern"], "^\\$.");
  EXPECT_TRUE(defs["condition"]["properties"]["seconds"].contains("oneOf"));
  EXPECT_EQ(defs["step"]["properties"]["label"]["type"], "string") << "a text may be one as it is";
  EXPECT_FALSE(defs["tool"]["properties"]["of_reference"].contains("oneOf"));
}

TEST(JsonRange, IsWhatANumberIsHeldTo) {
  const JsonObjectKeys keys{"thing",
                            {{"of_mm", true, "a number, > 0 and at most 3", json_type::number(above_zero_to(3))}}};
  const auto read = [&](const std::string& text) {
    const JsonValue value = parse_json("thing.json", text);
    return JsonObject(value, keys).number("of_mm");
  };
  EXPECT_EQ(read(R"({ "of_mm": 3 })"), 3);
  EXPECT_THROW(read(R"({ "of_mm": 0 })"), LoadError);
  EXPECT_THROW(read(R"({ "of_mm": 3.1 })"), LoadError);
}

/// Whatever its unit: sums of squares of such numbers are no numbers any more.
TEST(JsonRange, NoNumberIsBeyondAllMeasure) {
  const JsonObjectKeys keys{"thing", {{"of_mm", true, "a number", json_type::number()}}};
  const auto read = [&](const std::string& text) {
    const JsonValue value = parse_json("thing.json", text);
    return JsonObject(value, keys).number("of_mm");
  };
  EXPECT_EQ(read(R"({ "of_mm": -1e12 })"), -1e12);
  EXPECT_THROW(read(R"({ "of_mm": 1e13 })"), LoadError);
  EXPECT_THROW(read(R"({ "of_mm": -1e300 })"), LoadError);
}

TEST(JsonRange, IsWhatEachOfSeveralNumbersIsHeldTo) {
  const JsonObjectKeys keys{"thing",
                            {{"at_mm", true, "three numbers from -2 to 2", json_type::numbers(3, from_to(-2, 2))}}};
  const auto read = [&](const std::string& text) {
    const JsonValue value = parse_json("thing.json", text);
    return JsonObject(value, keys).numbers("at_mm", 3);
  };
  EXPECT_EQ(read(R"({ "at_mm": [-2, 0, 2] })").size(), 3u);
  EXPECT_THROW(read(R"({ "at_mm": [-2, 0, 2.1] })"), LoadError);
  EXPECT_THROW(read(R"({ "at_mm": [-1e308, 0, 0] })"), LoadError);
  EXPECT_THROW(read(R"({ "at_mm": [0, 0] })"), LoadError);
}

}  // namespace
}  // namespace ostium::data
