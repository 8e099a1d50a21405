/// Values of a file arrive in SI, shapes bend as they should, and instruments fit where they should.
#include "data/catalogue/instrument/instrument.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/units.h"
#include "core/model/state.h"
#include "core/rod/initial_state.h"
#include "data/catalogue/catalogue.h"
#include "tests/data/catalogue/instrument_files.h"

namespace ostium::data {
namespace {

/// The tip of the distal `length_m` at rest, in the material frame at its proximal end: (d1, d2, d3).
Eigen::Vector3d tip_at_rest(const Instrument& instrument, double length_m, int elements = 1024) {
  core::Model model;
  model.rods = {core::make_rod(rod_description(instrument, std::vector<double>(elements, length_m / elements)))};
  const core::State state = make_state_at_rest_shape(model, {core::EndState{}});
  return state.rods[0].position[elements];
}

TEST(Instrument, UnitsBecomeSI) {
  const Instrument hook = read_instrument("hook.json", small_catheter);
  EXPECT_EQ(hook.kind, InstrumentKind::guide_catheter);
  EXPECT_DOUBLE_EQ(hook.outer_diameter_m, 2e-3);
  EXPECT_DOUBLE_EQ(hook.inner_diameter_m, 1.8e-3);
  EXPECT_DOUBLE_EQ(hook.length_m, 1);
  const core::Section &tip = hook.sections.front(), &shaft = hook.sections.back();
  EXPECT_DOUBLE_EQ(tip.EI1_N_m2, 30e-6);
  EXPECT_DOUBLE_EQ(tip.EI2_N_m2, 30e-6);
  EXPECT_DOUBLE_EQ(tip.GJ_N_m2, 20e-6);
  EXPECT_DOUBLE_EQ(shaft.EI1_N_m2, 300e-6);
  EXPECT_DOUBLE_EQ(shaft.EI2_N_m2, 200e-6);
  EXPECT_DOUBLE_EQ(shaft.kg_per_m, 0.002);
  EXPECT_DOUBLE_EQ(shaft.to_tip_m, 1);
  EXPECT_DOUBLE_EQ(shaft.radius_m, 1e-3);
  EXPECT_DOUBLE_EQ(shaft.inner_radius_m, 0.9e-3);
  EXPECT_DOUBLE_EQ(hook.markers.at(0).from_tip_m, 5e-3);
  EXPECT_EQ(hook.markers.at(0).material, OpaqueMaterial::gold);
  EXPECT_DOUBLE_EQ(hook.opaque.at(0).thickness_m, 0.05e-3);
  EXPECT_DOUBLE_EQ(hook.passes_m, 1.75e-3);
  EXPECT_DOUBLE_EQ(hook.needs_m, 2e-3);
  EXPECT_EQ(source_mark(hook), "mixed");
  EXPECT_EQ(hook.sources.back().of, "clearance");
}

TEST(Instrument, RestCurvatureOfASectionBecomesSI) {
  std::string text =
      with(small_catheter, R"("GJ_Nmm2": 20,)", R"("GJ_Nmm2": 20, "rest_curvature_per_mm": [0.1, -0.2, 0.3],)");
  const std::size_t shape = text.find("  \"shape\"");
  text.erase(shape, text.find("  \"radiopacity\"") - shape);
  const Instrument bent = read_instrument("hook.json", text);
  EXPECT_TRUE(bent.sections[0].rest_curvature_per_m.isApprox(Eigen::Vector3d(100, -200, 300)));
  EXPECT_TRUE(bent.sections[1].rest_curvature_per_m.isZero());
}

TEST(Instrument, SectionsAreCutWhereTheShapeChanges) {
  const Instrument hook = read_instrument("hook.json", small_catheter);
  const double ends_mm[] = {10, 40, 10 + 10 * units::pi, 1000};
  ASSERT_EQ(hook.sections.size(), 4u);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(hook.sections[i].to_tip_m, ends_mm[i] * 1e-3, 1e-12);
  EXPECT_TRUE(hook.sections[0].rest_curvature_per_m.isZero());
  EXPECT_NEAR(hook.sections[1].rest_curvature_per_m.y(), 50, 1e-9);
  EXPECT_NEAR(hook.sections[2].rest_curvature_per_m.y(), 50, 1e-9);
  EXPECT_NEAR(hook.sections[2].EI1_N_m2, 300e-6, 1e-15);
  EXPECT_TRUE(hook.sections[3].rest_curvature_per_m.isZero());
}

TEST(Instrument, AHookBendsAsItsArcsSay) {
  // From 100 mm proximally: straight to the arc, a quarter circle of 20 mm, 10 mm straight. Links of 0.1 mm cut the
  // corners of arcs by less than length^2 / radius / 24 per radian: micrometres.
  const double straight_mm = 100 - 10 * units::pi - 10;
  for (const double plane_deg : {0.0, 90.0, 180.0, 30.0}) {
    const double plane = plane_deg * units::pi / 180;
    const Instrument hook = read_instrument(
        "hook.json", with(small_catheter, "\"plane_deg\": 0", "\"plane_deg\": " + std::to_string(plane_deg)));
    const Eigen::Vector3d expected(30 * std::cos(plane), 30 * std::sin(plane), straight_mm + 20);
    EXPECT_LT((1e3 * tip_at_rest(hook, 0.1) - expected).norm(), 0.05) << "plane " << plane_deg;
  }
}

/// Tip of a sequence of arcs in one plane, in closed form, in mm: (towards plane 0, along the base's tangent).
Eigen::Vector2d tip_of_arcs(const std::vector<ShapePiece>& pieces) {
  Eigen::Vector2d p(0, 0);
  double angle = 0;  // of the tangent from the base's, towards plane 0
  for (auto piece = pieces.rbegin(); piece != pieces.rend(); ++piece) {
    if (piece->radius_m == 0) {
      p += 1e3 * piece->length_m * Eigen::Vector2d(std::sin(angle), std::cos(angle));
      continue;
    }
    const double R = 1e3 * piece->radius_m * std::cos(piece->plane_rad), turned = angle + 1e3 * piece->length_m / R;
    p += R * Eigen::Vector2d(std::cos(angle) - std::cos(turned), std::sin(turned) - std::sin(angle));
    angle = turned;
  }
  return p;
}

TEST(Instrument, PreformedCathetersComeToTheirClosedForm) {
  int preformed = 0;
  for (const Instrument& instrument : load_catalogue()) {
    if (instrument.shape.empty()) continue;
    ++preformed;
    const Eigen::Vector2d expected = tip_of_arcs(instrument.shape);
    const Eigen::Vector3d tip = 1e3 * tip_at_rest(instrument, length_of(instrument.shape));
    EXPECT_NEAR(tip.x(), expected.x(), 0.05) << instrument.name;
    EXPECT_NEAR(tip.y(), 0, 1e-9) << instrument.name;
    EXPECT_NEAR(tip.z(), expected.y(), 0.05) << instrument.name;
  }
  EXPECT_GE(preformed, 12);
}

TEST(Instrument, OnlyATipThatCanBeShapedIsShaped) {
  const std::vector<Instrument> all = load_catalogue();
  const Instrument& wire = find_instrument(all, "wire-014-workhorse");
  const double radius = 3e-3, quarter = radius * units::pi / 2;
  const Instrument shaped = with_tip_shape(wire, {{.length_m = 1e-3}, {.length_m = quarter, .radius_m = radius}});
  const Eigen::Vector3d tip = tip_at_rest(shaped, quarter + 1e-3);
  EXPECT_NEAR(tip.x(), 4e-3, 1e-5);
  EXPECT_NEAR(tip.z(), 3e-3, 1e-5);
  const Eigen::Vector3d straight = tip_at_rest(with_tip_shape(shaped, {}), 20e-3);
  EXPECT_NEAR(straight.x(), 0, 1e-12);
  EXPECT_NEAR(straight.z(), 20e-3, 1e-12);
  EXPECT_NEAR(shaped.sections.back().to_tip_m, wire.length_m, 1e-12);
  EXPECT_THROW(with_tip_shape(wire, {{.length_m = 30e-3}}), std::invalid_argument);
  EXPECT_THROW(with_tip_shape(wire, {{.length_m = -1e-3}}), std::invalid_argument);
  EXPECT_THROW(with_tip_shape(find_instrument(all, "guide-jl4-6f"), {}), std::invalid_argument);
}

TEST(Instrument, ElementsAreAsLongAsShapeAllows) {
  for (const Instrument& instrument : load_catalogue()) {
    const std::vector<double> lengths = element_lengths(instrument);
    double from_tip = 0, longest = 0;
    for (auto length = lengths.rbegin(); length != lengths.rend(); ++length) {
      EXPECT_GT(*length, 0.4e-3) << instrument.name;
      if (from_tip < 0.03) {
        EXPECT_LE(*length, 1e-3 + 1e-12) << instrument.name << ": its tip is as fine as any";
      }
      for (const core::Section& section : instrument.sections)
        if (section.from_tip_m < from_tip + 1e-6 && section.to_tip_m > from_tip + *length - 1e-6) {
          EXPECT_TRUE(*length * section.rest_curvature_per_m.norm() < 0.201 || *length < 0.51e-3)
              << instrument.name << " at " << from_tip << ": " << *length;
        }
      from_tip += *length, longest = std::max(longest, *length);
    }
    EXPECT_NEAR(from_tip, instrument.length_m, 1e-6) << instrument.name;
    EXPECT_LE(longest, 8.5e-3) << instrument.name;
  }
  const std::vector<Instrument> all = load_catalogue();
  EXPECT_LT(element_lengths(find_instrument(all, "guide-jr4-6f")).size(), 240u) << "some 395 at 1 to 4 mm";
}

TEST(Instrument, AWireTooThickForItsCatheterIsRefused) {
  const std::vector<Instrument> all = load_catalogue();
  const auto get = [&](const char* name) -> const Instrument& { return find_instrument(all, name); };
  EXPECT_TRUE(fits_inside(get("guide-jl4-6f"), get("sheath-6f")));
  EXPECT_TRUE(fits_inside(get("j-wire-035-150"), get("diagnostic-jl4-5f")));
  EXPECT_TRUE(fits_inside(get("terumo-stiff-angled"), get("terumo-4f")));
  EXPECT_TRUE(fits_inside(get("balloon-25x15"), get("guide-jr4-6f")));
  EXPECT_TRUE(fits_inside(get("stent-30x18"), get("guide-ebu35-6f")));
  EXPECT_TRUE(fits_inside(get("wire-014-support"), get("stent-30x18")));
  EXPECT_FALSE(fits_inside(get("guide-jl4-6f"), get("diagnostic-jl4-5f")));
  EXPECT_FALSE(fits_inside(get("wire-014-support"), get("rosen")));
  EXPECT_NO_THROW(require_fit(get("wire-014-support"), get("balloon-25x15")));
  try {
    require_fit(get("j-wire-035-150"), get("balloon-25x15"));
    FAIL() << "0.035 in went through a lumen for 0.014 in";
  } catch (const std::invalid_argument& error) {
    for (const char* word : {"j-wire-035-150", "balloon-25x15", "0.889 mm", "0.0350 in", "0.420 mm"})
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what() << " lacks " << word;
  }
}

}  // namespace
}  // namespace ostium::data
