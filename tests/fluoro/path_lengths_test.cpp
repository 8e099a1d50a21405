#include "fluoro/projection/path_lengths.h"

#include <gtest/gtest.h>

#include "fluoro/matter/tissue.h"
#include "fluoro/phantom/shapes.h"
#include "tests/support/renderers.h"

namespace ostium::fluoro {

INSTANTIATE_TEST_SUITE_P(Renderers, DrawnBy, testing::Values(Renderer::scanline, Renderer::osmesa, Renderer::egl),
                         name_of);

namespace {

using Eigen::Vector3d;

PathLengths drawn(PathLengthRenderer& renderer, const std::vector<Body>& bodies, const View& view = {}) {
  PathLengths out(view.pixels);
  renderer.add(view, bodies, out);
  return out;
}

TEST_P(DrawnBy, TheVolumeOfABallIsWhatItsShadowHolds) {
  // In depth, and with the pixel width at the ball: rays are nearly parallel at 1 m for a ball of 1 cm.
  const double radius = 0.01;
  const std::vector<Body> ball{phantom::body("ball",
                                             phantom::star(
                                                 Vector3d::Zero(), [=](const Vector3d&) { return radius; }, 100),
                                             tissue::soft, tissue::air)};
  View view;
  view.field_m = 0.04;
  const double pixel_m = view.field_m / view.pixels * view.arm.source_to_isocentre_m / view.arm.source_to_detector_m;
  const PathLengths lengths = drawn(*by, ball, view);
  const double volume = double((lengths.soft_m()).cast<double>().sum()) * pixel_m * pixel_m;
  EXPECT_NEAR(volume / (4.0 / 3 * 3.14159265 * std::pow(radius, 3)), 1, 2e-3);
}

TEST_P(DrawnBy, AgreesWithScanlineWithinASilhouette) {
  const std::vector<Body> bodies{
      phantom::body("ellipsoid", phantom::ellipsoid({0.01, 0, 0}, {0.05, 0.03, 0.04}, 60), tissue::blood, tissue::air),
      phantom::body("bone", phantom::ellipsoid({0.01, 0, 0}, {0.01, 0.02, 0.01}, 40), tissue::cortical_bone,
                    tissue::blood)};
  const PathLengths a = drawn(*make_scanline_renderer(), bodies), b = drawn(*by, bodies);
  EXPECT_FALSE(find_leak(a));
  EXPECT_FALSE(find_leak(b));
  // Silhouettes differ by OpenGL's grid (1/256 pixel): in a few pixels, and noticeably on steep walls.
  const float soft_m = std::sqrt((a.soft_m() - b.soft_m()).square().mean());
  const float bone_m = std::sqrt((a.bone_m() - b.bone_m()).square().mean());
  EXPECT_LT(soft_m, 2e-5f);
  EXPECT_LT(bone_m, 2e-5f);
  RecordProperty("rms_soft_um", std::to_string(1e6f * soft_m));
  RecordProperty("rms_bone_um", std::to_string(1e6f * bone_m));
}

TEST_P(DrawnBy, ConcentrationCountsAlongTheRayNotFromTheSource) {
  // A vessel in the ray's plane with a concentration gradient: the middle ray crosses concentration times chord.
  const Eigen::Matrix3Xd line = phantom::smooth_line({{-0.03, 0, 0}, {0.03, 0, 0}}, 0.0005);
  const double radius = 0.002;
  constexpr int sides = 64;
  Body vessel = phantom::body("vessel", phantom::tube(line, Eigen::VectorXd::Constant(line.cols(), radius), sides),
                              tissue::soft, tissue::soft);
  vessel.contrast.p_PC = phantom::tube_centres(line, sides);
  vessel.contrast.iodine_kg_m3 = 150 + 2500 * vessel.contrast.p_PC.row(0).transpose().array();  // 75 to 225
  View view;
  const double scale = view.arm.source_to_detector_m / view.arm.source_to_isocentre_m * view.pixels / view.field_m;
  const PathLengths lengths = drawn(*by, {vessel}, view);
  for (double x : {-0.02, 0.0, 0.02}) {
    const auto column = static_cast<Eigen::Index>(view.pixels / 2 + scale * x);
    const double at = (double(column) + 0.5 - view.pixels / 2.0) / scale;
    EXPECT_NEAR(double(lengths.iodine_kg_m2().col(column).maxCoeff()), (150 + 2500 * at) * 2 * radius,
                0.01 * 150 * 2 * radius)
        << x;
  }
}

TEST_P(DrawnBy, AVesselAtAnyAngleHoldsItsIodine) {
  // The total of its shadow is concentration times volume, even if the vessel points at the detector.
  const double radius = 0.002, length = 0.04;
  constexpr int sides = 48;
  View view;
  view.field_m = 0.1;
  const double pixel_m = view.field_m / view.pixels * view.arm.source_to_isocentre_m / view.arm.source_to_detector_m;
  for (double angle : {0.3, 0.8, 1.57}) {  // to the ray
    const Vector3d half = length / 2 * Vector3d(std::sin(angle), 0, std::cos(angle));
    const Eigen::Matrix3Xd line = phantom::smooth_line({-half, half}, 0.0005);
    Body vessel = phantom::body("vessel", phantom::tube(line, Eigen::VectorXd::Constant(line.cols(), radius), sides),
                                tissue::soft, tissue::soft);
    vessel.contrast.p_PC = phantom::tube_centres(line, sides);
    vessel.contrast.iodine_kg_m3 = Eigen::VectorXf::Constant(vessel.p_P.cols(), 300);
    vessel.contrast.along_kg_m2 = 300 * vessel.contrast.p_PC;  // uniform: concentration times distance
    const double volume = 3.14159265 * radius * radius * length + 4.0 / 3 * 3.14159265 * std::pow(radius, 3);
    const PathLengths lengths = drawn(*by, {vessel}, view);
    const double held = double(lengths.iodine_kg_m2().cast<double>().sum()) * pixel_m * pixel_m;
    // Parts nearer than the isocentre are magnified: by (40 mm / 765 mm)^2 / 12 at most, on average.
    EXPECT_NEAR(held / (300 * volume), 1, 0.015) << angle;
  }
}

TEST_P(DrawnBy, TwoHalvesMakeAWhole) {
  const Body whole =
      phantom::body("whole", phantom::brick({-0.02, -0.02, -0.02}, {0.02, 0.02, 0.02}), tissue::soft, {});
  const Body left = phantom::body("left", phantom::brick({-0.02, -0.02, -0.02}, {0.003, 0.02, 0.02}), tissue::soft, {});
  const Body right =
      phantom::body("right", phantom::brick({0.003, -0.02, -0.02}, {0.02, 0.02, 0.02}), tissue::soft, {});
  View view;
  view.arm.lao_rad = 0.3;
  const PathLengths one = drawn(*by, {whole}, view), two = drawn(*by, {left, right}, view);
  // OpenGL's shader rounds corners to a grid of 1/256 pixel: 1.5 um here, seven times that on steep sides.
  EXPECT_LT((one.soft_m() - two.soft_m()).abs().maxCoeff(), 2e-5f);
}

TEST_P(DrawnBy, WhatRestsAndWhatMovesMakeAWhole) {
  Body heart = phantom::body("heart", phantom::ellipsoid({0.01, 0, 0}, {0.04, 0.03, 0.03}, 60), tissue::muscle, {});
  Body vessel = phantom::body("vessel", phantom::ellipsoid({-0.01, 0, 0.01}, {0.02, 0.01, 0.01}, 60), tissue::blood,
                              tissue::muscle);
  vessel.contrast.iodine_kg_m3 = (200 + 5e3 * vessel.p_P.row(0).array()).transpose();
  vessel.contrast.p_PC = 0.5 * vessel.p_P;
  vessel.contrast.along_kg_m2 = 100 * vessel.contrast.p_PC;
  const std::vector<Body> whole{heart, vessel};
  for (Body* body : {&heart, &vessel}) set_still([&](int v) { return body->p_P(1, v) > 0.004f; }, *body);
  EXPECT_GT(heart.still, 1000);
  EXPECT_LT(heart.still, heart.triangles->cols() - 1000);
  EXPECT_LT(heart.corners->size(), static_cast<std::size_t>(heart.p_P.cols()) - 500);
  const std::vector<Body> split{heart, vessel};
  EXPECT_THROW(check(Scene{{}, split, {}}), std::invalid_argument) << "nothing is fixed with which they could rest";
  EXPECT_NO_THROW(check(Scene{std::make_shared<const std::vector<Body>>(), split, {}}));
  View view;
  view.arm.lao_rad = 0.6;
  const PathLengths one = drawn(*by, whole, view);
  PathLengths two(view.pixels);
  by->add(view, split, two, Parts::still);
  EXPECT_TRUE((two.unmatched() != 0).any()) << "half a surface is open";
  by->add(view, split, two, Parts::moving);
  EXPECT_FALSE(find_leak(two));
  // The same triangles in another order: sums of floats of 0.1 m, 30 at most.
  EXPECT_LT((one.soft_m() - two.soft_m()).abs().maxCoeff(), 1e-6f);
  EXPECT_LT((one.bone_m() - two.bone_m()).abs().maxCoeff(), 1e-8f);
  EXPECT_LT((one.iodine_kg_m2() - two.iodine_kg_m2()).abs().maxCoeff(), 3e-5f);
  EXPECT_GT(one.iodine_kg_m2().maxCoeff(), 2);
}

TEST(PathLengths, TheRayIsLongerThanItsDepth) {
  View view;
  view.pixels = 2;
  const double half = 0.25 * view.field_m;  // pixel centres
  EXPECT_NEAR(double(ray_stretch(view)(0, 1)),
              std::sqrt(1 + 2 * half * half / std::pow(view.arm.source_to_detector_m, 2)), 1e-6);
}

}  // namespace
}  // namespace ostium::fluoro
