/// Predictions against the boundary-value solver, through the file format.
#include "data/identification/forward/prediction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/units.h"
#include "data/identification/forward/curve.h"
#include "data/identification/forward/setup.h"
#include "data/identification/measurement/measurement_reader.h"
#include "tests/data/refusals.h"
#include "tests/support/sets/synthetic_set.h"

namespace ostium::data {
namespace {

using Eigen::Vector3d;

MeasurementSet through_file(const MeasurementSet& set) {
  return read_measurement("set/measurement.json", synthetic::to_json(set));
}

/// Largest distance between points of the same arc length, mm.
double furthest_mm(const PredictedShape& shape, const boundary_value::Solution& exact, double length_m) {
  double worst = 0, s = 0;
  for (std::size_t i = 0; i < shape.points_m.size(); ++i) {
    if (i > 0) s += (shape.points_m[i] - shape.points_m[i - 1]).norm();
    const double at = s / length_m * static_cast<double>(exact.curve.size() - 1);
    const auto k = std::min(static_cast<std::size_t>(at), exact.curve.size() - 2);
    const Vector3d q = exact.curve[k] + (at - static_cast<double>(k)) * (exact.curve[k + 1] - exact.curve[k]);
    worst = std::max(worst, 1e3 * (shape.points_m[i] - q).norm());
  }
  return worst;
}

TEST(Prediction, CurvedRolledLoadedWiresAreWithinATenthOfAMillimetreOfTheBoundaryValueSolution) {
  const MeasurementSet set = through_file(synthetic::free_wire(12));
  const auto predictions = predict(set);
  ASSERT_EQ(predictions.size(), 12u);
  for (std::size_t e = 0; e < predictions.size(); ++e) {
    const auto exact = boundary_value::solve(synthetic::problem_of(set, set.experiments[e], {}), 2001);
    ASSERT_TRUE(exact.converged);
    EXPECT_LT(furthest_mm(predictions[e].shape, exact, set.experiments[e].set[0].inserted_m), 0.02) << e;
    EXPECT_LT(*predictions[e].rms_to_measured_m, 0.02e-3) << e;
  }
}

TEST(Prediction, SoAreNestedTubesAtTheirTips) {
  MeasurementSet set = synthetic::two_tubes(8);
  set.imaging.registration_free = set.imaging.tip_offset_free = false;
  for (const Prediction& p : predict(through_file(set))) EXPECT_LT(*p.rms_to_measured_m, 0.02e-3) << p.id;
  set.imaging.tip_offset_free = true;
  for (const Prediction& p : predict(through_file(set))) EXPECT_FALSE(p.rms_to_measured_m);
}

/// A declared effect: shafts that twist according to their GJ.
TEST(Prediction, DeclaredEffectsAreInTheModel) {
  MeasurementSet set = synthetic::two_tubes(6);
  set.imaging.registration_free = set.imaging.tip_offset_free = false;
  synthetic::Truth truth;
  truth.shaft_compliance = 1.4;
  synthetic::measure(set, truth);
  double rigid = 0;
  for (const Prediction& p : predict(through_file(set))) rigid = std::max(rigid, *p.rms_to_measured_m);
  EXPECT_GT(rigid, 1e-3);
  auto file = nlohmann::json::parse(synthetic::to_json(set));
  file["effects"] = {{{"id", "shaft_torsion"}, {"parameters", {{"compliance", 1.4}}}}};
  for (const Prediction& p : predict(read_measurement("m.json", file.dump())))
    EXPECT_LT(*p.rms_to_measured_m, 0.02e-3) << p.id;
}

/// Two tubes twisted against each other have two stable shapes; which one is found depends on the previous shape.
TEST(Prediction, ContinuesFromTheExperimentBefore) {
  MeasurementSet set = synthetic::two_tubes(1);
  set.imaging.registration_free = set.imaging.tip_offset_free = false;
  Experiment e = set.experiments[0];
  const auto with_roll = [&](double deg) {
    Experiment x = e;
    x.id = std::to_string(deg);
    x.set = {{0.14, 0, 0}, {0.14, deg * units::pi / 180, 0}};
    return x;
  };
  // Curved over their whole length, L k sqrt(1 + nu) = 2.2: they snap some way beyond 180 degrees, not at it.
  for (MeasuredInstrument& i : set.instruments)
    for (core::Section& s : i.sections) s.rest_curvature_per_m = {0, 13.5, 0};
  set.experiments = {with_roll(0), with_roll(190)};
  const auto forwards = predict(through_file(set));
  set.experiments = {with_roll(360), with_roll(190)};
  const auto backwards = predict(through_file(set));
  // The same drive positions; the shapes are mirror images except for 10 degrees.
  EXPECT_GT((forwards[1].shape.points_m.back() - backwards[1].shape.points_m.back()).norm(), 5e-3);
}

/// From a shape with the same number of elements, but longer ones.
TEST(Prediction, AShapeThatContinuesFromAnotherInsertionHasItsOwnLength) {
  MeasurementSet set = through_file(synthetic::free_wire(1));
  const std::vector<StaticEquilibrium> before = walk(set, {});
  set.experiments[0].set[0].inserted_m *= 0.9999;
  const ExperimentSetup setup = setup_of(set, set.experiments[0], {});
  const StaticEquilibrium straight_there = walk(set, {})[0];
  ASSERT_EQ(before[0].nest.carrier.rods[0].elements, straight_there.nest.carrier.rods[0].elements);
  const PredictedShape continued = shape_from(setup, before[0]), own = shape_from(setup, straight_there);
  EXPECT_LT((continued.points_m.back() - own.points_m.back()).norm(), 1e-9);
  double length = 0;
  for (std::size_t i = 1; i < continued.points_m.size(); ++i)
    length += (continued.points_m[i] - continued.points_m[i - 1]).norm();
  EXPECT_NEAR(length, set.experiments[0].set[0].inserted_m, 1e-9);
}

/// For an aligned pair, by hand: (E1 I1 k1 + E2 I2 k2) / (E1 I1 + E2 I2), with the specimen's own curvature.
TEST(Prediction, RadiusOfAPairIsThatOfACompositeBeam) {
  MeasurementSet set = synthetic::two_tubes(1);
  set.imaging = {};
  Experiment e = set.experiments[0];
  e.kind = Experiment::Kind::radius;
  e.points_m.clear();
  e.set = {{0.05, 0.7, 0}, {0.05, 0.7, 0}};
  e.specimen = {Eigen::Vector2d(0, 9.5), {}};
  e.radius_m = 0.1;
  const ExperimentSetup setup = setup_of(set, e, {});
  set.experiments = {e};
  const double k = (5500 * 9.5 + 2650 * 12.7) / (5500 + 2650);
  EXPECT_NEAR(radius_of_curvature(shape_from(setup, walk(set, {})[0]).points_m) * k, 1, 1e-3);
  EXPECT_NEAR(*predict(set)[0].rms_to_measured_m, std::fabs(0.1 - 1 / k), 1e-4);
}

TEST(Prediction, FilesHaveTheSchema) {
  const MeasurementSet set = through_file(synthetic::free_wire(2));
  const auto predictions = predict(set);
  const auto json = nlohmann::json::parse(to_json(predictions));
  EXPECT_EQ(json["schema"], "ostium-prediction/1");
  ASSERT_EQ(json["experiments"].size(), 2u);
  const auto& points = json["experiments"][1]["centreline_mm"];
  Vector3d before = Vector3d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector3d p(points[i][0], points[i][1], points[i][2]);
    if (i > 0) {
      EXPECT_LE((p - before).norm(), 2.0);
    }
    before = p;
  }
  EXPECT_NEAR((before - 1e3 * predictions[1].shape.points_m.back()).norm(), 0, 1e-5);
  EXPECT_TRUE(json["experiments"][0]["rms_to_measured_mm"].is_number());
  EXPECT_EQ(to_csv(predictions).substr(0, 30), "experiment,s_mm,x_mm,y_mm,z_mm");
  auto named = predictions;
  named[0].id = "=1,\"2\"";
  EXPECT_NE(to_csv(named).find("\n\"'=1,\"\"2\"\"\",0.000000,"), std::string::npos) << "no formula, and one field";
}

/// A load is spoken of only where there is one.
TEST(Prediction, WithoutAShapeItIsSaidWhatWasAsked) {
  MeasurementSet set = through_file(synthetic::free_wire(1));
  for (core::Section& s : set.instruments[0].sections) s.rest_curvature_per_m = {0, 2 * units::pi / 0.3 * 25, 0};
  set.experiments[0].set[0].inserted_m = 0.3;
  set.experiments[0].tip_force_N.setZero();
  expect_words(refusal_of([&] { predict(set); }),
               {"experiments[0]", "no static shape was found with 300 mm inserted", "makes 25 turns"});
  Experiment& e = set.experiments[0];
  const auto words = [&] { return no_static_shape(set, e, setup_of(set, e, {})); };
  EXPECT_EQ(words().find("load"), std::string::npos) << words();
  e.tip_force_N = {0, 0, 2.5};
  expect_words(words(), {"is 2.5 N at the tip more than it can bear?"});
  for (core::Section& s : set.instruments[0].sections) s.rest_curvature_per_m.setZero();
  e.tip_force_N.setZero();
  expect_words(words(), {"nothing pulls at its tip; are stiffness"});
}

TEST(Prediction, WhatIsNotKnownYetIsSaid) {
  auto file = nlohmann::json::parse(synthetic::to_json(synthetic::free_wire(1)));
  file["environment"]["vessel"] = {{"mesh", "a.stl"}, {"units", "mm"}, {"friction", 0.05}};
  EXPECT_THROW(predict(read_measurement("m.json", file.dump())), LoadError);
}

TEST(Shape, RadiusOfAnArcAndDistancesBeyondTheEnds) {
  std::vector<Vector3d> arc;
  for (int i = 0; i <= 40; ++i) arc.push_back({0.16 * std::sin(0.01 * i), 0.3, 0.16 * (1 - std::cos(0.01 * i))});
  EXPECT_NEAR(radius_of_curvature(arc), 0.16, 1e-9);
  const std::vector<Vector3d> line = {{0, 0, 0}, {0, 0, 0.1}, {0, 0, 0.2}};
  EXPECT_TRUE(std::isinf(radius_of_curvature(line)));
  EXPECT_LT((nearest_point(line, {0.01, 0, 0.5}) - Vector3d(0, 0, 0.5)).norm(), 1e-12);
  EXPECT_LT((nearest_point(line, {0.01, 0, -0.5}) - Vector3d(0, 0, -0.5)).norm(), 1e-12);
  EXPECT_LT((nearest_point(line, {0.01, 0, 0.05}) - Vector3d(0, 0, 0.05)).norm(), 1e-12);
  // Many points at once, on a coil, against a search of all edges.
  std::vector<Vector3d> coil, many;
  for (int i = 0; i <= 200; ++i) coil.emplace_back(0.02 * std::cos(0.1 * i), 0.02 * std::sin(0.1 * i), 1e-4 * i);
  for (int i = 0; i < 50; ++i)
    many.emplace_back(0.03 * std::sin(1.7 * i), 0.03 * std::cos(2.3 * i), 1e-2 + 0.02 * std::sin(3.1 * i));
  const std::vector<Vector3d> found = nearest_points(coil, many);
  for (std::size_t k = 0; k < many.size(); ++k) {
    double least = 1e9;
    for (std::size_t i = 0; i + 1 < coil.size(); ++i) {
      const Vector3d edge = coil[i + 1] - coil[i];
      double t = (many[k] - coil[i]).dot(edge) / edge.squaredNorm();
      if (i > 0) t = std::max(t, 0.0);
      if (i + 2 < coil.size()) t = std::min(t, 1.0);
      least = std::min(least, (many[k] - coil[i] - t * edge).norm());
    }
    EXPECT_NEAR((many[k] - found[k]).norm(), least, 1e-12);
  }
}

}  // namespace
}  // namespace ostium::data
