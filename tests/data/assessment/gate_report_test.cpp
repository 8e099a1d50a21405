#include "data/assessment/gate_report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace ostium::data {
namespace {

TEST(GateReport, PassesWithinTheToleranceOnly) {
  EXPECT_TRUE((GateResult{"g", 1.0, 0.9, 0.11, "mm"}.pass()));
  EXPECT_FALSE((GateResult{"g", 1.0, 0.9, 0.09, "mm"}.pass()));
  EXPECT_FALSE((GateResult{"g", NAN, 0.9, 1, "mm"}.pass()));
  EXPECT_FALSE(all_pass({{"a", 0, 0, 0, "1"}, {"b", 1, 0, 0, "1"}}));
}

TEST(GateReport, JsonHasTheSchemasKeys) {
  const auto json = nlohmann::json::parse(to_json({{"tip", 0.2, 0, 0.8, "mm"}, {"broken", NAN, 0, 1, "mm"}}));
  ASSERT_EQ(json.size(), 2u);
  EXPECT_EQ(
      json[0],
      (nlohmann::json{
          {"gate", "tip"}, {"value", 0.2}, {"reference", 0.0}, {"tolerance", 0.8}, {"unit", "mm"}, {"pass", true}}));
  EXPECT_TRUE(json[1]["value"].is_null());
  EXPECT_FALSE(json[1]["pass"]);
}

}  // namespace
}  // namespace ostium::data
