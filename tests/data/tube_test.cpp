/// What only an insertion shows: sets pushed into a tube by an independent solver (tests/support/pushed_chain.h), with
/// a friction or a wall that their file does not declare, are given the right name and number.
#include <gtest/gtest.h>

#include <cmath>

#include "data/fit/explanation.h"
#include "tests/support/undeclared.h"

namespace ostium {
namespace {

/// Against something that could be taken for it.
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

TEST(Tube, UndeclaredFrictionIsNamed) { is_named("wall_friction", "insertion_slip", 4); }

}  // namespace
}  // namespace ostium
