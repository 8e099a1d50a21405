/// Explanations of sets of projections, made by the boundary-value solver and the tests' own camera.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "data/catalogue/catalogue.h"
#include "data/identification/measurement/measurement_reader.h"
#include "data/identification/report/explanation_report.h"
#include "data/identification/selection/explain.h"
#include "tests/support/sets/judged.h"
#include "tests/support/sets/undeclared.h"

namespace ostium::data {
namespace {

using Json = nlohmann::ordered_json;

struct Effected {
  const char *id, *rival;
};

/// As a person tries them: the effect that was put in against another one.
class ViewEffect : public testing::TestWithParam<Effected> {};

TEST_P(ViewEffect, IsFoundAgainstARivalWithItsNumbers) {
  const synthetic::Undeclared made = synthetic::undeclared_set(std::string("views:") + GetParam().id, 1);
  const Explanation x = explain(made.set, {{{GetParam().id}, {GetParam().rival}}, 0, {}});
  ASSERT_EQ(x.verdict, Verdict::effect);
  EXPECT_EQ(x.best().effects, made.effects);
  EXPECT_GT(*x.declared.chi2_per_dof, 1.5);
  EXPECT_LT(*x.best().rms_held_out_m, 1.2 * *made.set.imaging.noise_sigma_m);
  for (const auto& [name, value] : made.truth) {
    bool fitted = false;
    for (const FittedParameter& p : x.best().parameters) {
      if (p.parameter.name != name) continue;
      fitted = true;
      EXPECT_LT(std::fabs(p.value - value), 3.5 * p.sigma) << name << " " << p.value << " +- " << p.sigma;
    }
    EXPECT_TRUE(fitted) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(Views, ViewEffect,
                         testing::Values(Effected{"view_angle", "view_shift"}, Effected{"view_shift", "view_angle"},
                                         Effected{"source_distance", "pincushion"},
                                         Effected{"pincushion", "source_distance"},
                                         Effected{"s_distortion", "pincushion"}, Effected{"table_sag", "view_shift"},
                                         Effected{"gantry_flex", "view_shift"},
                                         Effected{"second_plane_late", "view_shift"}),
                         [](const testing::TestParamInfo<Effected>& tested) { return std::string(tested.param.id); });

TEST(Views, NothingIsFoundWhereNothingIs) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const synthetic::Judged judged = synthetic::judge("views:clean", seed, 0);
    EXPECT_TRUE(judged.right) << seed << ": " << judged.said;
    EXPECT_NEAR(judged.chi2_before, 1, 0.2) << seed;
  }
}

/// Against everything that is in the library.
TEST(Views, AnAngleIsFoundAmongAllEffects) {
  const synthetic::Judged judged = synthetic::judge("views:view_angle", 1, 0);
  EXPECT_TRUE(judged.right) << judged.said;
  EXPECT_LT(judged.after, 1.2);
}

TEST(Views, ExchangedOnesAreNamed) {
  MeasurementSet set = synthetic::undeclared_set("views:clean", 1).set;
  std::swap(set.views[0].camera, set.views[1].camera);
  set.experiments.resize(4);
  ExplainOptions options;
  options.library = true;
  const Explanation x = explain(set, options);
  ASSERT_EQ(x.faults.size(), 1U);
  EXPECT_EQ(x.faults[0].id, "swapped_views");
  EXPECT_NEAR(*x.best().chi2_per_dof, 1, 0.2);
  EXPECT_TRUE(x.best().effects.empty());
}

/// A frame that is off along gravity looks the same, and both are said, each once.
TEST(Views, ATableThatSagsIsAmbiguous) {
  const synthetic::Judged judged = synthetic::judge("views:table_sag", 1, 0);
  EXPECT_EQ(judged.said, "ambiguous: table_sag or registration");
  EXPECT_TRUE(judged.right);
}

TEST(Views, NoiseIsToldFromPointToPoint) {
  MeasurementSet set = synthetic::undeclared_set("views:clean", 4).set;
  const double sigma = *set.imaging.noise_sigma_m;
  set.imaging.noise_sigma_m.reset();
  const Explanation x = explain(set, {});
  ASSERT_TRUE(x.noise.sigma_m);
  EXPECT_NEAR(*x.noise.sigma_m, sigma, 0.1 * sigma);
  EXPECT_EQ(x.verdict, Verdict::explained);
}

TEST(Views, EverythingIsInPixels) {
  const synthetic::Undeclared made = synthetic::undeclared_set("views:view_shift", 2);
  const std::string text = synthetic::to_json(made.set);
  const MeasurementSet set = read_measurement("m.json", text);
  const Explanation x = explain(set, {{{"view_shift"}}, 0, {}});
  const Json json = Json::parse(to_json(x));
  EXPECT_EQ(json["declared"]["unit"], "px");
  EXPECT_DOUBLE_EQ(json["declared"]["noise_sigma_px"], *set.imaging.noise_sigma_m);
  EXPECT_DOUBLE_EQ(json["after"]["rms"]["fit"], x.best().rms_m);
  EXPECT_NEAR(json["after"]["rms"]["fit"].get<double>() / *set.imaging.noise_sigma_m, 1, 0.1);
  EXPECT_NE(x.verdict_text[1].find(" px"), std::string::npos) << x.verdict_text[1];
  const std::string page = to_html(set, x);
  for (const char* words : {"View A", "View B", "all data, px", "column, px"})
    EXPECT_NE(page.find(words), std::string::npos) << words;
  // What was found is written into the set, where it is declared and leaves nothing to explain.
  const MeasurementSet now = read_measurement("amended.json", amended(text, set, x));
  ASSERT_EQ(now.effects.size(), 1u);
  const Explanation after = explain(now, {});
  EXPECT_EQ(after.verdict, Verdict::explained);
  EXPECT_NEAR(after.rms_nominal_m, x.best().rms_m, 0.02 * x.best().rms_m);
}

/// In one view, a C-arm that is off and a wire that is off look the same.
TEST(Views, OneViewIsEnoughForTheWire) {
  synthetic::Undeclared made = synthetic::undeclared_set("views:rest_curvature", 1);
  for (Experiment& e : made.set.experiments)
    std::erase_if(e.polylines, [](const ClickedPolyline& polyline) { return polyline.view != 0; });
  std::erase_if(made.set.experiments, [](const Experiment& e) { return e.polylines.empty(); });
  made.set.views.resize(1);
  const Explanation x = explain(made.set, {{{"rest_curvature"}, {"view_shift"}}, 0, {}});
  EXPECT_EQ(x.verdict, Verdict::effect);
  EXPECT_EQ(x.best().effects, made.effects);
  EXPECT_THROW(explain(made.set, {{{"second_plane_late"}}, 0, {}}), LoadError);
  EXPECT_THROW(explain(made.set, {{{"gantry_flex"}}, 0, {}}), LoadError);
}

TEST(Views, TheTemplateIsASetThatIsExplained) {
  const MeasurementSet set =
      load_measurement((std::filesystem::path(data_folder()) / "templates/projections").string());
  EXPECT_EQ(explain(set, {}).verdict, Verdict::explained);
}

TEST(Views, TheirEffectsNeedViews) {
  const MeasurementSet set = synthetic::free_wire(4);
  for (const char* id : {"view_angle", "view_shift", "source_distance", "pincushion", "s_distortion", "table_sag",
                         "gantry_flex", "second_plane_late"})
    EXPECT_THROW(explain(set, {{{id}}, 0, {}}), LoadError) << id;
}

}  // namespace
}  // namespace ostium::data
