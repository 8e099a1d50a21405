/// Effects that only an insertion shows: sets pushed into a tube by an independent solver
/// (tests/support/pushed_chain.h), with an undeclared friction or wall; the fit must name the effect and its value.
#include "core/samples/tube.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/units.h"
#include "data/identification/selection/explain.h"
#include "tests/support/dice.h"
#include "tests/support/pushed_chain.h"
#include "tests/support/sets/undeclared.h"
#include "tests/support/sets/undeclared_tube.h"

namespace ostium::data {
namespace {

/// Against an effect that could be mistaken for it.
void is_named(const std::string& effect, const std::string& rival, unsigned seed) {
  const synthetic::Undeclared made = synthetic::undeclared_set("tube:" + effect, seed);
  const Explanation x = explain(made.set, {{{rival}, {effect}}, 0, {}});
  EXPECT_EQ(x.verdict, Verdict::effect);
  EXPECT_GT(*x.declared.chi2_per_dof, 1.5);
  ASSERT_FALSE(x.candidates.empty());
  const FittedModel& best = x.candidates.front();
  EXPECT_EQ(best.effects, made.effects);
  EXPECT_LT(*best.rms_held_out_m, 1.2 * std::sqrt(2.0) * *made.set.imaging.noise_sigma_m);
  for (const auto& [name, value] : made.truth)
    for (const FittedParameter& p : best.parameters)
      if (p.parameter.name == name) {
        EXPECT_LT(std::fabs(p.value - value), 3 * p.sigma) << name << " " << p.value;
      }
}

TEST(Tube, UndeclaredComplianceIsNamed) { is_named("wall_compliance", "imaging_scale", 6); }

/// The push at the base, measured to 3 %, is fitted and predicted together with the shapes.
TEST(Tube, FrictionExplainsThePushAndSlipDoesNot) {
  using units::mm, units::Nmm2;
  const pushed_chain::Wire wire{{{0.05, 5 * Nmm2, 0.8e-3, 8}, {1, 30 * Nmm2, 0.8e-3, 0}}, 0.2e-3};
  const pushed_chain::Tube tube{0.05, 0.04, 1.3, 4e-3};
  const pushed_chain::Setting setting{0.3, {0.012, 0}, 9.81, 0.5e-3};
  const std::vector<double> inserted = {0.07, 0.1, 0.12, 0.105, 0.09};
  const auto rests = pushed_chain::push(tube, wire, setting, inserted);
  MeasurementSet set;
  set.title = "pushed", set.source = "tests";
  set.instruments = {synthetic::declared(wire, "wire", 0.3)};
  set.gravity_m_s2 = {0, 0, -9.81};
  set.imaging.noise_sigma_m = 0.2 * mm;
  const auto line = core::bend(tube.bend_radius_m, tube.angle_rad, tube.lead_m, 0.12, tube.radius_m, 1e-3);
  set.vessel =
      MeasuredVessel{"tube", "m", 0.05, std::make_shared<const core::SurfaceDescription>(core::tube(line, 48))};
  synthetic::Dice dice("push", 1);
  for (std::size_t k = 0; k < rests.size(); ++k) {
    ASSERT_TRUE(rests[k].converged);
    Experiment e;
    e.id = "d" + std::to_string(k), e.place = "experiments[" + std::to_string(k) + "]";
    e.base = synthetic::base_along_x(setting.base_m), e.specimen.resize(1);
    e.set = {{inserted[k], 0, 0}};
    for (std::size_t i = 0; i < rests[k].curve.size(); i += 10)
      e.points_m.push_back(Eigen::Vector3d(rests[k].curve[i].x(), 0, rests[k].curve[i].y()) +
                           *set.imaging.noise_sigma_m * dice.normals());
    e.proximal_force_N = rests[k].push_N * (1 + 0.03 * dice.normals().x());
    set.experiments.push_back(e);
  }
  const Explanation x = explain(set, {{{"insertion_slip"}, {"wall_friction"}}, 0, {}});
  ASSERT_EQ(x.verdict, Verdict::effect);
  ASSERT_EQ(x.best().effects, std::vector<std::string>{"wall_friction"});
  EXPECT_GT(*x.declared.push_rms_held_out_N, 5 * *x.best().push_rms_held_out_N);
  const FittedParameter& friction = x.best().parameters.back();
  EXPECT_NEAR(friction.value, 0.3, 3 * friction.sigma);
  EXPECT_LT(friction.sigma, 0.03);
}

}  // namespace
}  // namespace ostium::data
