/// What a camera in an artery sees.
#include "app/session/scene/angioscopy.h"

#include <gtest/gtest.h>

#include "data/formats/load_error.h"
#include "tests/app/session/short_treatment.h"

namespace ostium::app {
namespace {

/// Share of the picture's pixels that are lit, and of those that are more blue than red.
struct Shares {
  double lit = 0, blue = 0;
};
Shares shares_of(const Angioscopy& seen) {
  Shares out;
  const auto pixels = seen.rgb.size() / 3;
  for (std::size_t i = 0; i < pixels; ++i) {
    const int red = seen.rgb[3 * i], blue = seen.rgb[3 * i + 2];
    out.lit += red + blue > 60 ? 1.0 / static_cast<double>(pixels) : 0;
    out.blue += blue > red + 10 ? 1.0 / static_cast<double>(pixels) : 0;
  }
  return out;
}

TEST(Angioscopy, SeesTheWallAndAWireBeforeABranch) {
  ScriptedRun run(setup(), vessel());
  const Shares before = shares_of(look_inside(run.model, run.state, "RV", 64));
  EXPECT_GT(before.lit, 0.5);
  EXPECT_EQ(before.blue, 0) << "nothing lies in the artery";
  ASSERT_TRUE(run_to(run, 4)) << "the wire is across";
  EXPECT_GT(shares_of(look_inside(run.model, run.state, "RV", 64)).blue, 0.003);
  EXPECT_THROW(look_inside(run.model, run.state, "RCA", 64), data::LoadError);
  EXPECT_THROW(look_inside(run.model, run.state, "no such", 64), data::LoadError);
}

}  // namespace
}  // namespace ostium::app
