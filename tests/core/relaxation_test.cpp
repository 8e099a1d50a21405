/// Stress relaxation of a material: closed forms of the generalised Maxwell solid.
#include "core/rod/relaxation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "core/rod/initial_state.h"
#include "core/samples/steel_wire.h"

namespace ostium::core {
namespace {

using Eigen::Vector3d;

constexpr double rest_per_m = 8, EI = 1e-3, step_s = 1e-3;

/// A rod that is an arc at rest, with drag that damps its swing.
RodDescription arc(double EI_N_m2, double curvature_per_m, Relaxation relaxation) {
  RodDescription d;
  d.name = "arc";
  Section s;
  s.to_tip_m = 0.1;
  s.EI1_N_m2 = s.EI2_N_m2 = EI_N_m2, s.GJ_N_m2 = EI_N_m2 / 1.3;
  s.kg_per_m = 4e-3, s.radius_m = 0.5e-3, s.rest_curvature_per_m = {0, curvature_per_m, 0};
  d.sections = {s};
  d.element_lengths_m = equal_elements(d.sections, 50);
  d.damping = {1, 1, 1e-3};
  d.relaxation = relaxation;
  return d;
}

struct Trial {
  Trial(Model m, const std::vector<EndState>& bases)
      : model(std::move(m)), state(make_state(model, bases)), scratch(model) {
    inputs.rods.resize(model.rods.size());
  }
  void go_on(double seconds) {
    for (int n = 0; n < std::lround(seconds / step_s); ++n) step(model, inputs, state, scratch, report);
  }
  /// Curvature in the middle of a rod, 1/m.
  double curvature(int r) const {
    const Field<4>& q = state.rods[r].orientation;
    const int i = model.rods[r].elements / 2;
    const Eigen::Vector4d a = q[i - 5], b = q[i + 5];
    double length = 0;
    for (int j = i - 5; j < i + 5; ++j) length += model.rods[r].length.at(0)[j];
    return 2 * std::acos(std::min(1.0, std::fabs(a.dot(b)))) / length;
  }
  Model model;
  State state;
  Scratch scratch;
  Inputs inputs;
  StepReport report;
};

Model model_of(const std::vector<RodDescription>& rods) {
  Model model;
  model.gravity_W.setZero();
  for (const RodDescription& d : rods) model.rods.push_back(make_rod(d));
  return model;
}

double left(const Relaxation& r, double t) {
  double sum = 1;
  for (const Relaxation::Branch& b : r.branches) sum += b.fraction * std::expm1(-t / b.time_s);
  return sum;
}

TEST(Relaxation, HeldStraightItsMomentFallsByBothBranches) {
  const Relaxation r{{{0.2, 0.3}, {0.3, 1.5}}};
  Trial run(model_of({arc(EI, rest_per_m, r)}), {along_x()});
  run.inputs.rods[0].tip.hold = Hold::clamped;
  double t = 0;
  for (const double more : {0.1, 0.3, 0.6, 2.0}) {
    run.go_on(more);
    t += more;
    EXPECT_NEAR(run.report.rods[0].base_torque_W_Nm.norm(), EI * rest_per_m * left(r, t), 2e-3 * EI * rest_per_m) << t;
  }
  EXPECT_EQ(run.report.trouble, 0u);
}

/// Once released, it returns at the rate (1 - f) / t: the remaining strain is the branch's own, so c' = (f c - c) / t.
TEST(Relaxation, LetGoItComesBackFromWhereItWasHeld) {
  const Relaxation r{{{0.4, 0.5}, {0, 1}}};
  Trial run(model_of({arc(EI, rest_per_m, r)}), {along_x()});
  run.inputs.rods[0].tip.hold = Hold::clamped;
  run.go_on(1);
  const double crept = rest_per_m * -std::expm1(-1 / 0.5);
  run.inputs.rods[0].tip.hold = Hold::free;
  double t = 0;
  for (const double more : {0.2, 0.5, 1.0}) {
    run.go_on(more);
    t += more;
    EXPECT_NEAR(run.curvature(0), rest_per_m - 0.4 * crept * std::exp(-0.6 * t / 0.5), 0.015 * rest_per_m) << t;
  }
}

/// Curvature of a nested pair from its stiffnesses (ostium verify, nesting), with the relaxed part of the outer one's
/// removed.
TEST(Relaxation, InsideAnotherRodToo) {
  const Relaxation r{{{0.5, 0.2}, {0, 1}}};
  for (const bool inner_relaxes : {true, false}) {
    RodDescription outer = arc(EI, inner_relaxes ? 0 : rest_per_m, inner_relaxes ? Relaxation{} : r),
                   inner = arc(EI, inner_relaxes ? rest_per_m : 0, inner_relaxes ? r : Relaxation{});
    outer.sections[0].radius_m = 1e-3, outer.sections[0].inner_radius_m = 0.505e-3;
    Model model = model_of({outer, inner});
    model.nestings = coaxial({0, 1});
    Trial run(model, {along_x(), along_x()});
    run.go_on(0.1);
    EXPECT_GT(run.curvature(0), 0.43 * rest_per_m);
    run.go_on(2.9);
    // With f of it relaxed in the end, it bends with 1 - f of its stiffness.
    for (const int rod : {0, 1}) EXPECT_NEAR(run.curvature(rod), rest_per_m * 0.5 / 1.5, 0.01 * rest_per_m) << rod;
  }
}

TEST(Relaxation, IsPartOfTheState) {
  const Relaxation r{{{0.2, 0.3}, {0.3, 1.5}}};
  Trial run(model_of({arc(EI, rest_per_m, r)}), {along_x()});
  run.go_on(0.2);
  Trial other(run.model, {along_x()});
  State taken = make_state(run.model, {along_x()});
  restore(save(run.state), taken);
  other.state = taken;
  run.go_on(0.2), other.go_on(0.2);
  EXPECT_EQ(first_difference(run.state, other.state), "");
  const Trial without(model_of({arc(EI, rest_per_m, {})}), {along_x()});
  EXPECT_EQ(without.state.rods[0].crept_fast.size(), 0) << "those that do not relax pay nothing";
}

TEST(Relaxation, OfAllTheStiffnessIsRefused) {
  EXPECT_THROW(make_rod(arc(EI, 0, {{{0.6, 1}, {0.4, 1}}})), std::invalid_argument);
  EXPECT_THROW(make_rod(arc(EI, 0, {{{-0.1, 1}, {0, 1}}})), std::invalid_argument);
  EXPECT_THROW(make_rod(arc(EI, 0, {{{0.1, 0}, {0, 1}}})), std::invalid_argument);
}

}  // namespace
}  // namespace ostium::core
