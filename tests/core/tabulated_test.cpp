/// Bending by a curve: identities of the law, pure bending by hand, one answer in SIMD lanes and in doubles, and a wire
/// against the boundary-value solver.
#include "core/material/tabulated.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>

#include "core/concentric_tubes/concentric.h"
#include "core/model/rod.h"
#include "tests/support/boundary_value.h"

namespace ostium::core {
namespace {

/// Softens, stays soft, stiffens beyond what it was.
BendingCurve curve() { return {4, {1.5, 4, 6, 9}, {1, 0.3, 0.25, 1.4}}; }

RodDescription wire_with(const BendingCurve& bending) {
  RodDescription d{
      "wire", {round_section(0, 0.2, 0.18e-3, 0, 60e9, 0.3, 6450)}, std::vector<double>(100, 2e-3), {}, {}};
  d.sections[0].bending = bending;
  return d;
}

Tabulated law_of(double K1, double K2) {
  RodDescription d = wire_with(curve());
  d.sections[0].EI1_N_m2 = K1, d.sections[0].EI2_N_m2 = K2;
  return std::get<Tabulated>(make_rod(d).law);
}

TEST(Tabulated, MomentIsTheSlopeOfEnergyAndTangentThatOfMoment) {
  const double K1 = 40e-6, K2 = 25e-6;
  const Tabulated law = law_of(K1, K2);
  for (const auto& [x, y, z] : {std::array{0.3, -0.2, 3.0}, std::array{2.0, 1.0, -5.0}, std::array{-4.0, 3.3, 0.0},
                                std::array{7.0, 2.0, 1.0}, std::array{-30.0, 20.0, 0.0}}) {
    const double h = 1e-5;
    const auto e = [&](double a, double b) { return law.energy({a, b, z}, 50); };
    const auto m_at = [&](double a, double b) { return law.operator()<double>({a, b, z}, 50).moment; };
    const auto [m, C] = law.operator()<double>({x, y, z}, 50);
    EXPECT_NEAR(m.x, (e(x + h, y) - e(x - h, y)) / (2 * h), 1e-7 * K1 * 10);
    EXPECT_NEAR(m.y, (e(x, y + h) - e(x, y - h)) / (2 * h), 1e-7 * K1 * 10);
    EXPECT_NEAR(C.xx, (m_at(x + h, y).x - m_at(x - h, y).x) / (2 * h), 1e-4 * K1);
    EXPECT_NEAR(C.xy, (m_at(x, y + h).x - m_at(x, y - h).x) / (2 * h), 1e-4 * K1);
    EXPECT_NEAR(C.yy, (m_at(x, y + h).y - m_at(x, y - h).y) / (2 * h), 1e-4 * K1);
    EXPECT_GT(C.xx * C.yy - C.xy * C.xy, 0);
  }
}

/// By hand: 1.5 + 2.5 (1 + 0.3) / 2 at the second knot, 2 (0.3 + 0.25) / 2 more at the third, 3 (0.25 + 1.4) / 2 more
/// at the last, and 1.4 a unit beyond.
TEST(Tabulated, PureBendingIsTheCurve) {
  const Tabulated law = law_of(40e-6, 40e-6);
  for (const auto& [k, moment] : {std::array{1e-3, 1e-3}, std::array{1.5, 1.5}, std::array{4.0, 3.125},
                                  std::array{6.0, 3.675}, std::array{9.0, 6.15}, std::array{14.0, 13.15}}) {
    EXPECT_NEAR(curve().moment_per_m(k), moment, 1e-12);
    EXPECT_NEAR(curve().curvature_at(moment), k, 1e-9);
    const auto m = law.operator()<double>({0.6 * k, -0.8 * k, 2}, 50).moment;
    EXPECT_NEAR(std::hypot(m.x, m.y), 40e-6 * moment, 1e-6 * 40e-6 * moment);
    EXPECT_NEAR(m.y / m.x, -0.8 / 0.6, 1e-9);
  }
}

TEST(Tabulated, LanesAndDoublesAgreeToTheBit) {
  const Tabulated law = law_of(40e-6, 25e-6);
  const V3<Lanes> strain{{0.1, 2, -5, 11}, {0, -1, 3, 4}, {1, 2, 3, 4}};
  const auto lanes = law.operator()<Lanes>(strain, 48);
  for (int i = 0; i < lane_count; ++i) {
    const auto one = law.operator()<double>({strain.x[i], strain.y[i], strain.z[i]}, 48 + i);
    EXPECT_EQ(lanes.moment.x[i], one.moment.x);
    EXPECT_EQ(lanes.moment.y[i], one.moment.y);
    EXPECT_EQ(lanes.tangent.xx[i], one.tangent.xx);
    EXPECT_EQ(lanes.tangent.xy[i], one.tangent.xy);
    EXPECT_EQ(lanes.tangent.yy[i], one.tangent.yy);
  }
}

TEST(Tabulated, ARodWithoutACurveHasNotTheLawAndWrongCurvesAreRefused) {
  EXPECT_TRUE(std::holds_alternative<LinearElastic>(make_rod(wire_with({})).law));
  EXPECT_NEAR(stiffness_at_rest(make_rod(wire_with(curve())), 50).x(),
              stiffness_at_rest(make_rod(wire_with({})), 50).x(), 1e-9);
  BendingCurve bad = curve();
  bad.tangent[1] = 0;
  EXPECT_THROW(make_rod(wire_with(bad)), std::invalid_argument);
  bad = curve(), bad.curvature_per_m[2] = 3;
  EXPECT_THROW(make_rod(wire_with(bad)), std::invalid_argument);
  RodDescription both = wire_with(curve());
  both.sections[0].softening_per_m = 3, both.sections[0].softened_ratio = 0.5;
  EXPECT_THROW(make_rod(both), std::invalid_argument);
}

/// The shape of a loaded wire in two sections, weight and a curved tip included; its bends follow the same curve.
TEST(Tabulated, AWireBendsAsTheBoundaryValueSolverHasIt) {
  for (const BendingCurve& bending :
       {BendingCurve{3, {0.5, 1.5, 3}, {1, 0.4, 0.3}}, BendingCurve{3, {0.5, 1.5, 3}, {0.6, 0.4, 1.2}},
        BendingCurve{2, {0.5, 2}, {1.5, 2}}}) {
    Section tip = round_section(0, 0.05, 0.18e-3, 0, 60e9, 0.3, 6450), shaft = tip;
    tip.EI1_N_m2 = tip.EI2_N_m2 = 8e-6, tip.GJ_N_m2 = 6e-6, tip.rest_curvature_per_m = {8, -5, 0};
    shaft.from_tip_m = 0.05, shaft.to_tip_m = 0.6;
    shaft.EI1_N_m2 = shaft.EI2_N_m2 = 40e-6, shaft.GJ_N_m2 = 30e-6;
    boundary_value::Problem p;
    p.tubes = {{{tip, shaft}, 0.22, 0.7, 0}};
    p.tubes[0].more_curved = [&](double linear) { return linear > 0 ? bending.curvature_at(linear) / linear : 1; };
    p.gravity = {0, 0, -3};
    p.tip_force = {0, 2e-4, -1.5e-4};
    ConcentricDescription d;
    d.name = "wire";
    tip.bending = shaft.bending = bending;
    d.parts.push_back({{tip, shaft}, 0.22, 0.7, 0});
    constexpr int elements = 150;
    d.element_lengths_m.assign(elements, 0.22 / elements);
    const Concentric nest = make_concentric(d, p.gravity);
    ConcentricState state = straight_state(nest, {});
    ASSERT_TRUE(find_equilibrium(nest, {}, p.tip_force, state).converged);
    const boundary_value::Solution exact = boundary_value::solve(p, elements + 1);
    ASSERT_TRUE(exact.converged);
    for (int i = 0; i <= elements; ++i)
      EXPECT_LT((state.carrier.rods[0].position[i] - exact.curve.at(i)).norm(), 0.03e-3) << i;
  }
}

}  // namespace
}  // namespace ostium::core
