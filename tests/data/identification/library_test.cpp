/// Some of the sets that `ostium-campaign` makes by the hundred: an undeclared effect must be found, and nothing where
/// there is none.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "data/catalogue/instrument/instrument_reader.h"
#include "data/identification/effects/effect_list.h"
#include "data/identification/forward/prediction.h"
#include "data/identification/measurement/measurement_reader.h"
#include "data/identification/report/explanation_report.h"
#include "data/identification/selection/explain.h"
#include "tests/support/sets/judged.h"
#include "tests/support/sets/undeclared.h"

namespace ostium::data {
namespace {

using synthetic::Judged;

struct Case {
  const char* kind;
  unsigned seed;
};

class Undeclared : public testing::TestWithParam<Case> {};

TEST_P(Undeclared, IsFound) {
  const Judged judged = synthetic::judge(GetParam().kind, GetParam().seed, 0);
  EXPECT_TRUE(judged.right) << "said: " << judged.said;
  EXPECT_LT(judged.after, 1.2);
}

// Of each sort one: nothing, an effect of the instrument, one of the rig, faults that are named alone and with another
// experiment, noise; ostium-campaign has them all.
INSTANTIATE_TEST_SUITE_P(Library, Undeclared,
                         testing::Values(Case{"clean", 1}, Case{"clean", 2}, Case{"soft_section", 1},
                                         Case{"clamp_runout", 1}, Case{"fault:roll_in_radians", 1},
                                         Case{"fault:swapped", 1}, Case{"noise:shared", 1}),
                         [](const testing::TestParamInfo<Case>& tested) {
                           std::string kind = tested.param.kind;
                           std::replace(kind.begin(), kind.end(), ':', '_');
                           return kind + "_" + std::to_string(tested.param.seed);
                         });

/// An effect that no law of the library has is given none of their names.
TEST(Library, WhatItLacksIsUnexplained) {
  const synthetic::Undeclared made = synthetic::undeclared_set("out:shear", 1);
  const Explanation x = explain(made.set, {{{"registration"}, {"rest_curvature"}, {"imaging_scale"}}, 0, {}});
  EXPECT_EQ(x.verdict, Verdict::unexplained);
  EXPECT_GT(*x.declared.chi2_per_dof, 1.5);
}

/// A single curved wire whose curvature relaxes with time.
TEST(Library, RelaxationOfAnInstrumentAlone) {
  const synthetic::Undeclared made = synthetic::undeclared_set("stress_relaxation", 1);
  const Explanation x = explain(made.set, {{{"stress_relaxation"}}, 0, {}});
  EXPECT_EQ(x.verdict, Verdict::effect);
  EXPECT_GT(*x.declared.chi2_per_dof, 1.5);
  ASSERT_EQ(x.candidates.size(), 1u);
  EXPECT_LT(*x.candidates[0].chi2_per_dof, 1.25);
  EXPECT_LT(*x.candidates[0].rms_held_out_m, 1.2 * std::sqrt(2.0) * *made.set.imaging.noise_sigma_m);
}

/// The instrument file for other commands contains the effects of the instrument, and none of the rig.
TEST(Library, TheInstrumentIsWrittenAsItWasFound) {
  const synthetic::Undeclared made = synthetic::undeclared_set("rest_curvature", 1);
  const Explanation x = explain(made.set, {{{"rest_curvature"}}, 0, {}});
  ASSERT_EQ(x.verdict, Verdict::effect);
  const std::string text = instrument_json(made.set, x, 0);
  const Instrument found = read_instrument("instrument.json", text);
  ASSERT_EQ(found.sections.size(), made.set.instruments[0].sections.size());
  for (std::size_t s = 0; s < found.sections.size(); ++s) {
    const core::Section &now = found.sections[s], &declared = made.set.instruments[0].sections[s];
    EXPECT_NEAR(now.EI1_N_m2, declared.EI1_N_m2 * x.best().changes.stiffness_scale[0][s], 1e-9 * declared.EI1_N_m2);
    const Eigen::Vector3d add = now.rest_curvature_per_m - declared.rest_curvature_per_m;
    EXPECT_NEAR(add.x(), 1e3 * x.best().changes.effects[0].values[0], 1e-6);
    EXPECT_NEAR(add.y(), 1e3 * x.best().changes.effects[0].values[1], 1e-6);
  }
}

/// A unit that was wrong once is right in the amended set, and the explanation's file says whose it was.
TEST(Library, AFaultIsMendedInTheAmendedSet) {
  synthetic::Undeclared made = synthetic::undeclared_set("clean", 1);
  const double roll = made.set.experiments[4].set[0].roll_rad;
  made.set.experiments[4].set[0].inserted_m /= 10;
  ExplainOptions options;
  options.library = true;
  const Explanation x = explain(made.set, options);
  EXPECT_EQ(x.verdict, Verdict::effect);
  const auto json = nlohmann::json::parse(to_json(x));
  EXPECT_EQ(json["effects"], nlohmann::json({"unit_error"}));
  EXPECT_EQ(json["faults"][0]["experiments"], nlohmann::json({"x4"}));
  EXPECT_EQ(json["noise"]["as_declared"], true);
  const std::string text = amended(synthetic::to_json(made.set), made.set, x);
  const MeasurementSet after = read_measurement("amended/measurement.json", text);
  EXPECT_NEAR(after.experiments[4].set[0].inserted_m, 10 * made.set.experiments[4].set[0].inserted_m, 1e-9);
  EXPECT_NEAR(after.experiments[4].set[0].roll_rad, roll, 1e-9);
  EXPECT_FALSE(to_html(made.set, x).empty());
}

/// A line that was measured from the tip to the base is read so, with a word; one that is too short is told.
TEST(Library, LengthsThatDoNotFitAreSaid) {
  synthetic::Undeclared made = synthetic::undeclared_set("clean", 2);
  std::vector<Eigen::Vector3d>& turned = made.set.experiments[3].points_m;
  std::reverse(turned.begin(), turned.end());
  made.set.experiments[5].points_m.resize(made.set.experiments[5].points_m.size() / 2);
  ExplainOptions options;
  options.library = true;
  const Explanation x = explain(made.set, options);
  EXPECT_EQ(x.verdict, Verdict::explained);
  ASSERT_EQ(x.warnings.size(), 2u);
  EXPECT_NE(x.warnings[0].find("x3"), std::string::npos);
  EXPECT_NE(x.warnings[1].find("x5"), std::string::npos);
}

/// Two centrelines have numbers enough.
TEST(Library, TwoExperimentsAreEnoughForAnEffect) {
  synthetic::Undeclared made = synthetic::undeclared_set("registration", 1);
  made.set.experiments.resize(2);
  ExplainOptions options;
  options.library = true;
  const Explanation x = explain(made.set, options);
  EXPECT_NE(x.verdict, Verdict::unexplained);
  EXPECT_NE(x.verdict, Verdict::explained);
  ASSERT_FALSE(x.candidates.empty());
  EXPECT_LT(*x.candidates[0].chi2_per_dof, 1.5);
}

/// Too few numbers: no verdict, but a suggestion of what to measure.
TEST(Library, ASetTooSmallToDecideIsAmbiguous) {
  synthetic::Undeclared made = synthetic::undeclared_set("clean", 1);
  made.set.experiments.resize(2);
  for (Experiment& e : made.set.experiments) {
    e.kind = Experiment::Kind::tip;
    e.points_m = {e.points_m.back() + Eigen::Vector3d(0, 0.004, 0.003)};
  }
  ExplainOptions options;
  options.library = true;
  const Explanation x = explain(made.set, options);
  EXPECT_EQ(x.verdict, Verdict::ambiguous);
  ASSERT_TRUE(x.next_experiment);
  EXPECT_FALSE(x.next_experiment->why.empty());
  const auto json = nlohmann::json::parse(to_json(x));
  EXPECT_EQ(json["verdict"], "ambiguous");
  EXPECT_EQ(json["next_experiment"]["set"].size(), 1u);
}

}  // namespace
}  // namespace ostium::data
