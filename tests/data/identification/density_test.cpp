/// Iodine along an artery: its law against closed forms, and sets of an independent solver against what they were made
/// with.
#include "data/identification/curves/density/density.h"

#include <cmath>
#include <filesystem>

#include "data/identification/curves/curve_explanation.h"
#include "data/identification/curves/kinds.h"
#include "tests/data/refusals.h"
#include "tests/support/sets/density_set.h"

namespace ostium::data::density_test {
namespace {

using density::Beat;
using density::Film;

constexpr double diameter_m = 3e-3, flow_m3_s = 2e-6, k_m2_kg = 1.2, iodine_kg_m3 = 350;
const double area_m2 = M_PI / 4 * diameter_m * diameter_m;

/// A tube with steady flow, and one injection without ramps.
density::Setup tube(double rate_m3_s) {
  density::Setup out;
  out.place_m = Eigen::Vector2d(0, 0.1), out.diameter_m = Eigen::Vector2d(diameter_m, diameter_m);
  out.site_m = Eigen::Vector2d(0.03, 0.09);
  out.sampled = {0.8, {0, 0.5, 1}, {1, 1, 1}};
  out.m2_per_kg = k_m2_kg, out.dispersion_m3 = 15e-9;
  Film film;
  film.injection = {rate_m3_s, 0.5, 2, 0, iodine_kg_m3};
  film.flow_m3_s = flow_m3_s;
  film.time_s = Eigen::VectorXd::LinSpaced(2001, 0, 4);
  out.films = {film};
  return out;
}

double at(const density::Setup& setup, const Eigen::VectorXd& curve, double time_s) {
  const Eigen::VectorXd& t = setup.films[0].time_s;
  const double place = time_s / (t[1] - t[0]), part = place - std::floor(place);
  const auto i = static_cast<Eigen::Index>(place);
  return (1 - part) * curve[i] + part * curve[i + 1];
}

const double undiluted_mm = k_m2_kg * iodine_kg_m3 * area_m2 / 1e-3;

TEST(Density, PlugAndItsFront) {
  const density::Setup setup = tube(1e-6);
  const curves::Curves y = density::densities(setup)[0];
  for (const Eigen::Index s : {0, 1}) {
    const double volume = area_m2 * setup.site_m[s], spread_m3 = std::sqrt(2 * 15e-9 * volume);
    const double arrives = 0.5 + volume / flow_m3_s, sd_s = spread_m3 / flow_m3_s;
    // Half of the injection's rate over the flow of iodine is on the plateau; half of that where the front is.
    EXPECT_NEAR(y[s].maxCoeff(), undiluted_mm / 2, 1e-3 * undiluted_mm);
    EXPECT_NEAR(at(setup, y[s], arrives), undiluted_mm / 4, 2e-3 * undiluted_mm);
    // A standard deviation behind it, what a normal law has there.
    EXPECT_NEAR(at(setup, y[s], arrives + sd_s), 0.5 * 0.841345 * undiluted_mm, 2e-3 * undiluted_mm);
    EXPECT_NEAR(at(setup, y[s], arrives + 2 - sd_s), 0.5 * 0.841345 * undiluted_mm, 2e-3 * undiluted_mm);
  }
}

TEST(Density, MoreThanTheFlowRunsBack) {
  EXPECT_NEAR(density::densities(tube(5e-6))[0][0].maxCoeff(), undiluted_mm, 1e-3 * undiluted_mm);
}

TEST(Density, AllIodinePassesEverySite) {
  density::Setup setup = tube(1e-6);
  setup.dispersion_m3 = 5e-9;
  setup.branch = {0.05, 0.4};
  const curves::Curves y = density::densities(setup)[0];
  const double dt = setup.films[0].time_s[1], injected_kg = 2 * 1e-6 * iodine_kg_m3;
  const auto passed = [&](Eigen::Index s) { return y[s].sum() * dt * 1e-3 / (k_m2_kg * area_m2) * flow_m3_s; };
  EXPECT_NEAR(passed(0), injected_kg, 2e-3 * injected_kg);
  // Behind the branch the same concentration passes for as long, with less flow.
  EXPECT_NEAR(passed(1), injected_kg, 2e-3 * injected_kg);
}

TEST(Density, InflowThinsAndHurries) {
  density::Setup setup = tube(1e-6);
  setup.inflow = {0.05, 0.5};
  const curves::Curves y = density::densities(setup)[0];
  EXPECT_NEAR(y[1].maxCoeff(), undiluted_mm / 2 / 1.5, 1e-3 * undiluted_mm);
  const double arrives = 0.5 + area_m2 * (0.05 + 0.04 / 1.5) / flow_m3_s;
  EXPECT_NEAR(at(setup, y[1], arrives), undiluted_mm / 4 / 1.5, 3e-3 * undiluted_mm);
}

TEST(Density, ForeshortenedLengthsHoldMore) {
  density::Setup setup = tube(1e-6);
  density::foreshortening().apply({0.8}, setup);
  const curves::Curves y = density::densities(setup)[0];
  EXPECT_NEAR(y[0].maxCoeff(), undiluted_mm / 2 / 0.8, 2e-3 * undiluted_mm);
  EXPECT_NEAR(at(setup, y[0], 0.5 + area_m2 * 0.03 / 0.8 / flow_m3_s), undiluted_mm / 4 / 0.8, 3e-3 * undiluted_mm);
}

TEST(Density, StepsOfABeat) {
  Beat smooth{1, {}, {}}, stepped{1, {}, {}};
  for (int k = 0; k <= 20; ++k) {
    const double p = k / 20.0;
    smooth.phase.push_back(p), smooth.relative.push_back(1 + 0.9 * std::sin(2 * M_PI * p));
    stepped.phase.push_back(p), stepped.relative.push_back(p < 0.4 || p == 1 ? 0.4 : 1.5);
  }
  EXPECT_TRUE(density::steps_of(smooth).empty());
  const auto steps = density::steps_of(stepped);
  ASSERT_EQ(steps.size(), 2u);
  EXPECT_DOUBLE_EQ(steps[0].at_phase, 0.375);
  EXPECT_EQ(steps[1].at_phase, 1);  // the last sample is the next beat's first
  const Beat beat = density::with_steps(stepped, steps);
  EXPECT_EQ(beat.phase.size(), 25u);
}

curves::CurveExplanation explained(const std::string& json) {
  return curves::explain_curves(parse_json("made.json", json), {});
}

TEST(Density, CleanSetAndItsFlow) {
  const bench_sets::MadeSet made = bench_sets::density_set("", 0, 11);
  const curves::CurveExplanation x = explained(made.json);
  EXPECT_EQ(x.verdict, Verdict::explained);
  for (std::size_t r = 0; r < made.flow_mL_s.size(); ++r)
    EXPECT_NEAR(x.declared.parameters[r].value, made.flow_mL_s[r], 0.01 * made.flow_mL_s[r]);
}

/// Between two, as a search of all takes half a minute.
TEST(Density, NamesWhatIsUndeclared) {
  curves::CurveOptions two;
  two.tries = {{"frame_rate"}, {"concentration"}};
  const JsonValue made = parse_json("made.json", bench_sets::density_set("concentration", 3, 12).json);
  const curves::CurveExplanation x = curves::explain_curves(made, two);
  EXPECT_EQ(x.verdict, Verdict::effect);
  ASSERT_FALSE(x.candidates.empty());
  EXPECT_EQ(x.candidates[0].effects, std::vector<std::string>{"concentration"});
}

TEST(Density, WhatIsWrongIsNamed) {
  const std::string good = bench_sets::density_set("", 0, 13).json;
  const auto refused = [&](const std::string& what, const std::string& by) {
    std::string bad = good;
    const auto place = bad.find(what);
    EXPECT_NE(place, std::string::npos) << what;
    bad.replace(place, what.size(), by);
    return refusal_of([&] { curves::read_set(parse_json("made.json", bad)); });
  };
  expect_words(refused("\"sites_mm\"", "\"site_mm\""), {"made.json", "site_mm"});
  expect_words(refused("0.0333, 0.0667, 0.1,", "0.0333, 0.0667, 0.05,"), {"runs[0].time_s[3]", "more than the 0.0667"});
  expect_words(refused("\"time_s\": [0, ", "\"time_s\": ["), {"runs[0].density_mm[0]", "165 numbers", "expected 164"});
  expect_words(refused("\"frames_per_s\": 30", "\"frames_per_s\": 0.03"), {"runs[0].frames_per_s", "another unit"});
  expect_words(refused("\"rate_mL_s\": 1.2", "\"rate_mL_s\": -1.2"), {"runs[0].injection.rate_mL_s"});
  expect_words(refused("\"id\": \"i1\"", "\"id\": \"i0\""), {"runs[1].id"});
  expect_words(refused("\"linear\": true", "\"linear\": false"), {"density_mm[0]", "not linear", "leave frames"});
}

/// The set of another group's generator, where it lies beside the checkout.
TEST(Density, SetOfAnotherGenerator) {
  const char* given = std::getenv("OSTIUM_MEASURED");
  const std::filesystem::path checkout = std::filesystem::path(__FILE__).parent_path().parent_path().parent_path();
  const std::filesystem::path file =
      (given ? std::filesystem::path(given) : checkout.parent_path() / "shared" / "measured") / "kinds" /
      "density-example.json";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "set OSTIUM_MEASURED to the folder of the measured sets";
  EXPECT_EQ(curves::explain_curves(load_json(file.string()), {}).verdict, Verdict::explained);
}

}  // namespace
}  // namespace ostium::data::density_test
