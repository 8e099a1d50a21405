#include "fluoro/matter/scene.h"

#include <gtest/gtest.h>

#include "fluoro/detector/imager.h"
#include "fluoro/matter/tissue.h"
#include "fluoro/phantom/chest.h"
#include "fluoro/phantom/shapes.h"
#include "tests/support/renderers.h"

namespace ostium::fluoro {
namespace {

using Eigen::Vector3d;

Body ball(double radius_m = 0.03) {
  return phantom::body("ball",
                       phantom::star(
                           Vector3d::Zero(), [=](const Vector3d&) { return radius_m; }, 40),
                       tissue::soft, tissue::air);
}

std::string complaint(const Body& body) {
  try {
    check(body);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

Body with_hole(Body body) {
  body.triangles = std::make_shared<const Triangles>(body.triangles->leftCols(body.triangles->cols() - 1));
  return body;
}

TEST(Scene, ShapesAreClosed) {
  EXPECT_EQ(complaint(ball()), "");
  EXPECT_EQ(complaint(phantom::body("brick", phantom::brick({0, 0, 0}, {1, 1, 1}), tissue::soft, tissue::air)), "");
  const Eigen::Matrix3Xd line = phantom::smooth_line({{0, 0, 0}, {0.01, 0.02, 0}, {0.03, 0.02, 0.02}}, 0.001);
  const Eigen::VectorXd radius = Eigen::VectorXd::Constant(line.cols(), 0.002);
  EXPECT_EQ(complaint(phantom::body("tube", phantom::tube(line, radius, 12, true), tissue::soft, tissue::air)), "");
  EXPECT_EQ(complaint(phantom::body("tube", phantom::tube(line, radius, 12, false), tissue::soft, tissue::air)), "");
}

TEST(Scene, AnOpenBodyIsNamedWithItsHole) {
  const std::string words = complaint(with_hole(ball()));
  EXPECT_NE(words.find("\"ball\""), std::string::npos) << words;
  EXPECT_NE(words.find("3 open edges"), std::string::npos) << words;
  EXPECT_NE(words.find("mm"), std::string::npos) << words;
}

TEST(Scene, ATriangleTurnedRoundIsFound) {
  Body body = ball();
  Triangles triangles = *body.triangles;
  std::swap(triangles(0, 100), triangles(1, 100));
  body.triangles = std::make_shared<const Triangles>(triangles);
  EXPECT_NE(complaint(body).find("not closed"), std::string::npos);
}

TEST(Scene, OtherMistakesAreNamed) {
  Body body = ball();
  body.p_P(1, 7) = NAN;
  EXPECT_NE(complaint(body).find("not a number"), std::string::npos);
  body = ball();
  body.p_P.conservativeResize(3, 100);
  EXPECT_NE(complaint(body).find("100"), std::string::npos);
  body = ball();
  body.contrast.iodine_kg_m3 = Eigen::VectorXf::Constant(5, 300);
  EXPECT_NE(complaint(body).find("contrast"), std::string::npos);
}

TEST_P(DrawnBy, WhatIsDrawnOpenIsALeakThatNamesItsBody) {
  Body sound = ball(), open = with_hole(ball(0.02));
  open.name = "open ball";
  open.triangles = std::make_shared<const Triangles>(open.triangles->leftCols(open.triangles->cols() / 2));
  Imager imager({}, std::move(by));
  View view;
  view.pixels = 128;
  ImagerState state;
  const Scene scene{nullptr, {sound, open}, {}};
  EXPECT_GT(imager.frame({scene, view, {}, fluoroscopy()}, state).leak.pixels, 0);
  EXPECT_EQ(imager.leaking({scene, view, {}, fluoroscopy()}), "open ball");
  EXPECT_TRUE(state.lag.shown.allFinite());
  ImagerState again;
  EXPECT_FALSE(imager.frame({{nullptr, {sound}, {}}, view, {}, fluoroscopy()}, again).leak);
}

TEST(Scene, AHollowInNothingIsALeak) {
  Body hollow = ball();
  std::swap(hollow.tissue, hollow.within);  // air in place of tissue, where there is none
  Imager imager({}, make_scanline_renderer());
  ImagerState state;
  const Scene scene{nullptr, {hollow}, {}};
  EXPECT_NEAR(imager.frame({scene, {}, {}, fluoroscopy()}, state).leak.worst_m, -0.06, 0.001);
  EXPECT_NE(imager.leaking({scene, {}, {}, fluoroscopy()}).find("outside"), std::string::npos);
}

TEST(Scene, TheChestPhantomIsSoundInEveryView) {
  phantom::ChestOptions options;
  options.filling = phantom::Filling::left;
  const Scene scene = phantom::chest(options);
  EXPECT_NO_THROW(check(scene));
  Imager imager({}, make_scanline_renderer());
  for (double lao : {-30.0, 0.0, 45.0})
    for (double cran : {-30.0, 25.0}) {
      View view;
      view.arm.lao_rad = lao * 3.14159265 / 180;
      view.arm.cran_rad = cran * 3.14159265 / 180;
      view.pixels = 256;
      ImagerState state;
      const FrameReport report = imager.frame({scene, view, {}, fluoroscopy()}, state);
      EXPECT_FALSE(report.leak) << lao << " " << cran << ": " << report.leak.worst_m;
    }
}

}  // namespace
}  // namespace ostium::fluoro
