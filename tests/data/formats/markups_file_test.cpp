/// Centrelines of 3D Slicer: what its curves say becomes tubes; what cannot be one is refused by its place.
#include "data/catalogue/case/markups_file.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/base/units.h"
#include "tests/data/refusals.h"

namespace ostium::data::markups_test {
namespace {

using units::mm;
using Json = nlohmann::json;

Json curve(const std::vector<std::array<double, 3>>& points, const std::vector<double>& radii) {
  Json control = Json::array();
  for (const auto& p : points) control.push_back({{"label", "C"}, {"position", p}, {"positionStatus", "defined"}});
  return {{"type", "Curve"},
          {"coordinateSystem", "LPS"},
          {"coordinateUnits", "mm"},
          {"controlPoints", control},
          {"measurements",
           {{{"name", "length"}, {"enabled", true}, {"value", 20.0}, {"units", "mm"}},
            {{"name", "Radius"}, {"enabled", false}, {"controlPointValues", radii}}}}};
}

const Json trunk = curve({{0, 0, 0}, {20, 0, 0}, {40, 0, 0}}, {2, 2, 1.5});
const Json branch = curve({{21, 0.5, 0}, {25, 10, 0}, {30, 20, 0}}, {1, 1, 0.8});

std::vector<vascular::Tube> read(const Json& file) { return read_markups("lines.mrk.json", file.dump(1)).tubes; }
std::string refusal(const Json& file) {
  return refusal_of([&] { read(file); });
}

TEST(Markups, CurvesBecomeTubesWithTheirBranches) {
  const Json point = {{"type", "Fiducial"}, {"controlPoints", Json::array()}};
  const std::vector<vascular::Tube> tubes = read({{"@schema", "markups"}, {"markups", {point, trunk, branch}}});
  ASSERT_EQ(tubes.size(), 2u);
  EXPECT_EQ(tubes[0].parent, -1);
  EXPECT_EQ(tubes[1].parent, 0);
  EXPECT_NEAR(tubes[0].length_m(), 40 * mm, 1e-9);
  EXPECT_NEAR(tubes[0].nodes.front().radius_m, 2 * mm, 1e-12);
  EXPECT_NEAR(tubes[0].nodes.back().radius_m, 1.5 * mm, 1e-12);
  EXPECT_LT((tubes[1].nodes.back().p - mm * Eigen::Vector3d(30, 20, 0)).norm(), 1e-9);
}

TEST(Markups, KeepTheirAxesAndSayWhichTheyAre) {
  Json ras = trunk;
  ras["coordinateSystem"] = "RAS";
  const Markups found = read_markups("lines.mrk.json", Json{{"markups", {ras}}}.dump());
  EXPECT_EQ(found.axes, "RAS");
  EXPECT_LT((found.tubes[0].nodes.back().p - mm * Eigen::Vector3d(40, 0, 0)).norm(), 1e-9);
  EXPECT_EQ(read_markups("lines.mrk.json", Json{{"markups", {trunk}}}.dump()).axes, "LPS");
  EXPECT_NE(refusal({{"markups", {trunk, ras}}}).find("is in RAS, and the curves before it are in LPS"),
            std::string::npos);
}

TEST(Markups, OfOlderSlicersHaveNumbersForRASAndLPS) {
  Json ras = trunk, lps = trunk;
  ras["coordinateSystem"] = "0";
  lps["coordinateSystem"] = "1";
  EXPECT_EQ(read_markups("lines.mrk.json", Json{{"markups", {ras}}}.dump()).axes, "RAS");
  EXPECT_EQ(read_markups("lines.mrk.json", Json{{"markups", {lps}}}.dump()).axes, "LPS");
}

TEST(Markups, PointsThatAreNotPlacedArePassedOver) {
  for (const char* status : {"undefined", "preview", "missing"}) {
    Json lines = trunk;
    lines["controlPoints"][1]["positionStatus"] = status;
    lines["controlPoints"][1]["position"] = {0, 30, 0};
    const std::vector<vascular::Tube> tubes = read({{"markups", {lines}}});
    EXPECT_NEAR(tubes[0].length_m(), 40 * mm, 1e-9) << status;
    EXPECT_NEAR(tubes[0].nodes.back().radius_m, 1.5 * mm, 1e-12) << status;
    lines["controlPoints"][1].erase("position");
    EXPECT_NEAR(read({{"markups", {lines}}})[0].length_m(), 40 * mm, 1e-9) << status;
  }
}

/// They took minutes: a tube that runs to and fro in itself.
TEST(Markups, PointsOutOfOrderAreRefusedAtTheFirst) {
  std::vector<std::array<double, 3>> points;
  for (int k = 0; k < 60; ++k) points.push_back({20 * std::cos(0.1 * k), 20 * std::sin(0.1 * k), 0.3 * k});
  const std::vector<double> radii(points.size(), 1.5);
  EXPECT_EQ(read({{"markups", {curve(points, radii)}}}).size(), 1u);
  std::swap(points[20], points[40]);
  expect_words(refusal({{"markups", {curve(points, radii)}}}), {"lines.mrk.json:", "controlPoints[20]", "in order"});
  for (std::size_t k = 0; k < points.size(); ++k) std::swap(points[k], points[(37 * k) % points.size()]);
  expect_words(refusal({{"markups", {curve(points, radii)}}}), {"lines.mrk.json:", "not in order along the vessel"});
}

TEST(Markups, WhatMakesNoVesselIsRefusedByItsPlace) {
  Json bare = trunk, inches = trunk, few = trunk, far = trunk, thin = trunk, one = trunk, axes = trunk, wide = trunk;
  bare["measurements"] = Json::array();
  expect_words(refusal({{"markups", {bare}}}), {"lines.mrk.json:", "markups[0]", "Radius", "Extract Centerline"});
  inches["coordinateUnits"] = "in";
  expect_words(refusal({{"markups", {inches}}}), {"coordinateUnits", "mm"});
  few["measurements"][1]["controlPointValues"] = {2, 2};
  expect_words(refusal({{"markups", {few}}}), {"controlPointValues", "3 values"});
  wide["measurements"][1]["units"] = "cm";
  expect_words(refusal({{"markups", {wide}}}), {"measurements[1].units", "cm", "mm"});
  far["controlPoints"][1]["position"][0] = 1e9;
  expect_words(refusal({{"markups", {trunk, far}}}), {"markups[1].controlPoints[1].position[0]", "5000"});
  thin["measurements"][1]["controlPointValues"][2] = -1;
  expect_words(refusal({{"markups", {thin}}}), {"controlPointValues[2]", "radius"});
  for (Json& point : one["controlPoints"]) point["position"] = {1, 2, 3};
  expect_words(refusal({{"markups", {one}}}), {"two control points"});
  axes["coordinateSystem"] = "scanner";
  expect_words(refusal({{"markups", {axes}}}), {"coordinateSystem", "RAS"});
  expect_words(refusal({{"markups", Json::array()}}), {"no curve"});
  expect_words(refusal({{"marks", 1}}), {"markups"});
}

}  // namespace
}  // namespace ostium::data::markups_test
