#include "fluoro/projection/c_arm.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/units.h"

namespace ostium::fluoro {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using units::degree;

TEST(CArm, DetectorStandsWhereTheAnglesSay) {
  const auto at = [](double lao, double cran) {
    return towards_detector({.lao_rad = lao * degree, .cran_rad = cran * degree});
  };
  EXPECT_LT((at(0, 0) - Vector3d(0, 0, 1)).norm(), 1e-15);     // AP: in front
  EXPECT_LT((at(90, 0) - Vector3d(1, 0, 0)).norm(), 1e-15);    // LAO 90: on the patient's left
  EXPECT_LT((at(-90, 0) - Vector3d(-1, 0, 0)).norm(), 1e-15);  // RAO 90
  EXPECT_GT(at(0, 25).y(), 0);                                 // cranial: towards the head
  EXPECT_NEAR(at(37, -22).norm(), 1, 1e-15);
}

TEST(CArm, IsocentreIsInTheMiddleOfEveryView) {
  for (double lao : {-60.0, -30.0, 0.0, 45.0, 90.0})
    for (double cran : {-30.0, 0.0, 25.0}) {
      const CArm arm{.lao_rad = lao * degree, .cran_rad = cran * degree, .p_PI = Vector3d(0.1, -0.2, 0.3)};
      EXPECT_LT(project(arm, arm.p_PI)->norm(), 1e-15);
      EXPECT_NEAR((source(arm) - arm.p_PI).norm(), arm.source_to_isocentre_m, 1e-15);
    }
}

TEST(CArm, MagnifiesByDistancesAndKeepsDirections) {
  const CArm ap;
  const double scale = ap.source_to_detector_m / ap.source_to_isocentre_m;
  EXPECT_LT((*project(ap, {0.01, 0, 0}) - Vector2d(0.01 * scale, 0)).norm(),
            1e-15);  // left is on the right of the image
  EXPECT_LT((*project(ap, {0, 0.01, 0}) - Vector2d(0, 0.01 * scale)).norm(), 1e-15);  // the head is up
  EXPECT_NEAR(project(ap, {0.01, 0, -0.1})->x() / project(ap, {0.01, 0, 0.1})->x(),
              (ap.source_to_isocentre_m + 0.1) / (ap.source_to_isocentre_m - 0.1),
              1e-12);  // nearer the source is larger
  // In a left lateral view, the front of the patient is on the left of the image.
  EXPECT_LT(project({.lao_rad = 90 * degree}, {0, 0, 0.01})->x(), 0);
  EXPECT_GT(project({.lao_rad = 45 * degree, .cran_rad = 25 * degree}, {0, 0.01, 0})->y(), 0);
}

TEST(CArm, WhatIsBehindTheSourceHasNoImage) {
  const CArm ap;
  EXPECT_FALSE(project(ap, {0, 0, -1}));
  EXPECT_FALSE(project(ap, source(ap)));
}

}  // namespace
}  // namespace ostium::fluoro
