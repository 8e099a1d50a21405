#include "fluoro/base/lanes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostium::fluoro {
namespace {

TEST(Lanes, ExponentialAndLogarithmAreThoseOfTheLibrary) {
  for (float x = -86; x < 86; x += 0.0371f) {
    const double e = std::exp(double{x});
    EXPECT_NEAR(double{exponential(all(x))[3]} / e, 1, 2e-7 + 1e-7 * std::fabs(x)) << x;
    const auto y = static_cast<float>(e);
    EXPECT_NEAR(double{logarithm(all(y))[5]}, std::log(double{y}), 1e-7 + 1.2e-7 * std::fabs(x)) << x;
  }
  EXPECT_LT(exponential(all(-1e4f))[0], 2e-38f);
  EXPECT_GT(exponential(all(1e4f))[0], 8e37f);
}

TEST(Lanes, TheEndOfARowIsReadAndWrittenAlone) {
  float row[10] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
  store(2 * load(row + 6, 3), row + 6, 3);
  EXPECT_EQ(row[5], 5);
  EXPECT_EQ(row[6], 12);
  EXPECT_EQ(row[8], 16);
  EXPECT_EQ(row[9], 9);
  EXPECT_EQ(load(row, 2)[2], 0);
}

}  // namespace
}  // namespace ostium::fluoro
