#include "core/material/section.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "core/base/units.h"
#include "core/model/rod.h"

namespace ostium::core {
namespace {

RodDescription two_sections() {
  RodDescription d;
  d.name = "test wire";
  d.sections = {round_section(0, 0.03, 0.1e-3, 0, 60e9, 0.3, 6500),
                round_section(0.03, 0.2, 0.2e-3, 0, 60e9, 0.3, 6500)};
  d.element_lengths_m = equal_elements(d.sections, 40);
  return d;
}

/// The message of the exception that make_rod throws for a description.
template <class Spoil>
std::string refusal(Spoil&& spoil) {
  RodDescription d = two_sections();
  spoil(d);
  try {
    make_rod(d);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Section, RefusalsNameTheRodTheSectionAndTheValue) {
  const auto expect = [](const std::string& message, std::initializer_list<const char*> words) {
    for (const char* word : words) EXPECT_NE(message.find(word), std::string::npos) << message << " lacks " << word;
  };
  expect(refusal([](RodDescription& d) { d.sections[1].from_tip_m = 0.04; }),
         {"test wire", "section 1", "0.04", "gap"});
  expect(refusal([](RodDescription& d) { d.sections[1].from_tip_m = 0.02; }), {"section 1", "overlap"});
  expect(refusal([](RodDescription& d) { d.sections[0].to_tip_m = -0.01; }), {"section 0", "length must be positive"});
  expect(refusal([](RodDescription& d) { d.sections[1].EI2_N_m2 = 0; }), {"section 1", "EI2", "positive"});
  expect(refusal([](RodDescription& d) { d.sections[0].GJ_N_m2 = NAN; }), {"section 0", "GJ", "finite"});
  expect(refusal([](RodDescription& d) { d.sections[0].kg_per_m = -1; }), {"section 0", "weight"});
  expect(refusal([](RodDescription& d) { d.sections[0].inner_radius_m = 0.2e-3; }), {"section 0", "inner radius"});
  expect(refusal([](RodDescription& d) { d.sections[0].rest_curvature_per_m.x() = INFINITY; }),
         {"section 0", "curvature"});
  expect(refusal([](RodDescription& d) { d.sections[0].rest_curvature_per_m.y() = 1.1e4; }),
         {"section 0", "curvature", "11000", "below 10000", "outer radius"});
  expect(refusal([](RodDescription& d) { d.sections.clear(); }), {"test wire", "no section"});
  expect(refusal([](RodDescription& d) { d.element_lengths_m.resize(15); }), {"15 elements", "16 to 4096"});
  expect(refusal([](RodDescription& d) { d.element_lengths_m.assign(5000, 1e-5); }), {"5000 elements"});
  expect(refusal([](RodDescription& d) { d.element_lengths_m[3] = -0.1; }), {"element", "positive"});
  expect(refusal([](RodDescription& d) { d.element_lengths_m[3] = 0.1; }), {"sections only"});
  expect(refusal([](RodDescription& d) { d.sections[0].rest_curvature_per_m.y() = 1000; }),
         {"test wire", "bends too sharply", "shorter elements", "curvature", "from the tip"});
  expect(refusal([](RodDescription& d) { d.damping.drag_along_N_s_m2 = -1; }), {"damping"});
}

TEST(Section, RoundSectionHasTextbookStiffness) {
  // A steel wire of 0.889 mm: I = 0.03066 mm^4 (Harrison 2011), so EI at 9.5 GPa is 291 N mm2.
  const Section s = round_section(0, 1, 0.4445e-3, 0, 9.5e9, 0.3, 7800);
  EXPECT_NEAR(s.EI1_N_m2 * 1e6, 291.3, 0.1);
  EXPECT_NEAR(s.GJ_N_m2 / s.EI1_N_m2, 1 / 1.3, 1e-12);
  EXPECT_NEAR(s.kg_per_m, 7800 * units::pi * 0.4445e-3 * 0.4445e-3, 1e-12);
}

TEST(Rod, ElementsShareMassAndComplianceWithoutLoss) {
  const RodDescription d = two_sections();
  const Rod rod = make_rod(d);
  double mass = 0, compliance = 0, inertia = 0;
  for (int i = 0; i <= rod.elements; ++i) {
    mass += rod.mass.at(0)[i];
    compliance += rod.joint_length.at(0)[i] / stiffness_at_rest(rod, i).x();
  }
  for (int j = 0; j < rod.elements; ++j) inertia += rod.rotary_inertia.at(1)[j];
  const Section &tip = d.sections[0], &shaft = d.sections[1];
  EXPECT_NEAR(mass, 0.03 * tip.kg_per_m + 0.17 * shaft.kg_per_m, 1e-15);
  EXPECT_NEAR(rod.total_mass_kg, mass, 1e-15);
  EXPECT_NEAR(compliance, 0.03 / tip.EI1_N_m2 + 0.17 / shaft.EI1_N_m2, 1e-9 * compliance);
  EXPECT_NEAR(inertia, 0.03 * tip.kg_per_m * 0.5e-8 + 0.17 * shaft.kg_per_m * 2e-8, 1e-18);  // m r^2 / 2
}

TEST(Rod, UnequalElementsAndAPartlyInsertedRodAreFine) {
  RodDescription d = two_sections();
  d.element_lengths_m.assign(20, 0.002);                             // 4 cm of coarse elements at the base
  d.element_lengths_m.insert(d.element_lengths_m.end(), 40, 0.001);  // 4 cm of fine ones at the tip
  const Rod rod = make_rod(d);
  EXPECT_NEAR(rod.total_length_m, 0.08, 1e-15);
  EXPECT_NEAR(rod.total_mass_kg, 0.03 * d.sections[0].kg_per_m + 0.05 * d.sections[1].kg_per_m, 1e-15);
  EXPECT_NEAR(rod.joint_length.at(0)[20], 0.0015, 1e-15);
}

}  // namespace
}  // namespace ostium::core
