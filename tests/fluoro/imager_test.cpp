#include "fluoro/detector/imager.h"

#include <gtest/gtest.h>

#include <thread>

#include "core/base/units.h"
#include "fluoro/base/resample.h"
#include "fluoro/console/fluoroscope.h"
#include "fluoro/matter/tissue.h"
#include "fluoro/phantom/chest.h"
#include "fluoro/phantom/shapes.h"
#include "tests/support/renderers.h"

namespace ostium::fluoro {
namespace {

View small_view() {
  View view;
  view.arm.lao_rad = 0.5;
  view.pixels = 128;
  return view;
}

Scene water(double thickness_m) {
  const double half = 0.5 * thickness_m;
  auto bodies = std::make_shared<std::vector<Body>>();
  bodies->push_back(phantom::body("water", phantom::brick({-0.2, -0.2, -half}, {0.2, 0.2, half}), tissue::soft, {}));
  return {bodies, {}, {}};
}

Plane after(const Scene& scene, int frames, std::uint64_t seed, Renderer renderer) {
  Imager imager({}, make_renderer(renderer));
  ImagerState state;
  for (int i = 0; i < frames; ++i) imager.frame({scene, small_view(), {}, fluoroscopy(), seed}, state);
  return state.lag.shown;
}

TEST_P(DrawnBy, SameSeedSamePictureBitForBitOnAnyNumberOfThreads) {
  phantom::ChestOptions options;
  options.filling = phantom::Filling::left;
  const Scene scene = phantom::chest(options);
  const Plane once = after(scene, 3, 7, GetParam());
  std::vector<Plane> together(3);
  std::vector<std::thread> threads;
  for (Plane& plane : together) threads.emplace_back([&] { plane = after(scene, 3, 7, GetParam()); });
  for (std::thread& thread : threads) thread.join();
  for (const Plane& plane : together) EXPECT_TRUE((plane == once).all());
  EXPECT_FALSE((after(scene, 3, 8, GetParam()) == once).all());
}

TEST(Imager, NoiseOfFramesAndPixelsIsIndependent) {
  ImagerModel model;
  model.detector_blur_m = 0;
  Imager imager(model, make_scanline_renderer());
  const Scene scene = water(0.2);
  Programme programme = fluoroscopy();
  programme.lag = 0;
  ImagerState state;
  std::vector<Eigen::ArrayXXd> noise;
  for (int i = 0; i < 3; ++i) {
    imager.frame({scene, {}, {}, programme, 3}, state);
    noise.push_back(state.lag.shown.block(128, 128, 256, 256).cast<double>());
    noise.back() -= noise.back().mean();
  }
  const auto correlation = [](const Eigen::ArrayXXd& a, const Eigen::ArrayXXd& b) {
    return (a * b).mean() / std::sqrt(a.square().mean() * b.square().mean());
  };
  const double chance = 4 / 256.0;  // 4 standard deviations of 65536 pairs; the background's slow fall adds to it
  EXPECT_LT(std::fabs(correlation(noise[0], noise[1])), 2 * chance);
  EXPECT_LT(std::fabs(correlation(noise[1], noise[2])), 2 * chance);
  for (int apart : {1, 2, 7}) {
    EXPECT_LT(std::fabs(correlation(noise[0].leftCols(200), noise[0].middleCols(apart, 200))), 2 * chance);
    EXPECT_LT(std::fabs(correlation(noise[0].topRows(200), noise[0].middleRows(apart, 200))), 2 * chance);
  }
}

TEST(Imager, NoiseFallsWithTheLagFilterAsItMust) {
  // Variance of shown = (1 - lag) new + lag shown before: (1 - lag) / (1 + lag) of a single picture's.
  const Scene scene = water(0.2);
  const auto deviation = [&](double lag) {
    Imager imager({}, make_scanline_renderer());
    Programme programme = fluoroscopy();
    programme.lag = lag;
    ImagerState state;
    for (int i = 0; i < 20; ++i) imager.frame({scene, {}, {}, programme, 4}, state);
    const Eigen::ArrayXXd middle = state.lag.shown.block(192, 192, 128, 128).cast<double>();
    return std::sqrt((middle - middle.mean()).square().mean());
  };
  EXPECT_NEAR(deviation(0.5) / deviation(0), std::sqrt(0.5 / 1.5), 0.03);
}

/// How much a layer of blood with iodine darkens the middle of a picture, as a logarithm.
double shadow(double iodine_kg_m3, float thickness_m) {
  Scene scene = water(0.15);
  Body cell = phantom::body("cell", phantom::brick({-0.03, -0.03, -thickness_m / 2}, {0.03, 0.03, thickness_m / 2}),
                            tissue::soft, tissue::soft);
  cell.contrast.iodine_kg_m3 = Eigen::VectorXf::Constant(8, float(iodine_kg_m3));
  cell.contrast.p_PC = Eigen::Matrix3Xf::Zero(3, 8);
  scene.moving.push_back(cell);
  Imager imager({}, make_scanline_renderer());
  Programme bright = cine();
  bright.detector_dose_nGy = 1e7;
  bright.kerma_limit_Gy_s = 1e9;
  ImagerState state;
  View view;
  view.pixels = 128;
  imager.frame({scene, view, {}, bright, 1}, state);
  return -std::log(double(state.lag.shown.block(60, 60, 8, 8).mean()));
}

TEST(Imager, AHalfFilledVesselIsHalfAsDark) {
  const double none = shadow(0, 1e-3f), half = shadow(50, 1e-3f) - none, full = shadow(100, 1e-3f) - none;
  EXPECT_GT(full, 0.03);
  EXPECT_NEAR(half / full, 0.5, 0.02);  // slightly less because of beam hardening and scatter
}

TEST(Imager, WhatIsLeftOutOfAVesselCouldNotBeSeen) {
  const float layer = 0.03f, faintest = faintest_iodine_kg_m3;
  const double none = shadow(0, layer);
  EXPECT_EQ(shadow(faintest, layer), none);
  EXPECT_GT(shadow(1.01 * faintest, layer), none) << "a little more is drawn";
  EXPECT_LT((shadow(100 * faintest, layer) - none) / 100, 1.0 / 2000);
}

TEST(Imager, AutomaticBrightnessHoldsTheDetectorDose) {
  Imager imager({}, make_scanline_renderer());
  double kerma_before = 0, kV_before = 0;
  for (double thickness : {0.12, 0.16, 0.20, 0.24}) {
    const Scene scene = water(thickness);
    const Exposure e = imager.exposure({scene, {}, {}, fluoroscopy(), 1});
    EXPECT_NEAR(e.detector_dose_nGy, 30, 1e-6);
    EXPECT_NEAR(e.patient_m, thickness, 0.003);
    EXPECT_GT(e.kerma_Gy, kerma_before);
    EXPECT_GE(e.tube.peak_kV, kV_before);
    kerma_before = e.kerma_Gy;
    kV_before = e.tube.peak_kV;
  }
  // Fluoroscopy is limited to 88 mGy/min at the reference point.
  const Scene thick = water(0.45);
  const Exposure limited = imager.exposure({thick, {}, {}, fluoroscopy(), 1});
  EXPECT_NEAR(limited.kerma_Gy * 15 * 60, 0.088, 1e-6);
  EXPECT_LT(limited.detector_dose_nGy, 30);
}

TEST(Imager, DoseAreaProductIsKermaTimesAreaAtAnyDistance) {
  Imager imager({}, make_scanline_renderer());
  const Scene scene = water(0.2);
  const View view;
  const Exposure open = imager.exposure({scene, view, {}, fluoroscopy(), 1});
  // At the reference point the field is smaller by the ratio of distances, and kerma larger by its square.
  const double ratio = (view.arm.source_to_isocentre_m - 0.15) / view.arm.source_to_detector_m;
  EXPECT_NEAR(open.dose_area_Gy_m2 / (open.kerma_Gy * std::pow(view.field_m * ratio, 2)), 1, 1e-9);
  const Exposure shut = imager.exposure({scene, view, {0.25, 0.25, 0.25, 0.25}, fluoroscopy(), 1});
  EXPECT_NEAR(shut.dose_area_Gy_m2 / open.dose_area_Gy_m2, 0.25, 1e-9);
}

TEST(Imager, EveryFieldHasAPicture) {
  // Blurs are wider in pixels for smaller fields: the weights must not overflow.
  for (double field_m : {0.20, 0.16, 0.13, 0.10}) {
    View view = small_view();
    view.field_m = field_m;
    Imager imager({}, make_scanline_renderer());
    ImagerState state;
    const FrameReport report = imager.frame({water(0.2), view, {}, fluoroscopy(), 1}, state);
    EXPECT_TRUE(state.lag.shown.isFinite().all()) << field_m;
    EXPECT_NEAR(report.exposure.detector_dose_nGy, 30 * 0.2 / field_m, 1e-6) << field_m;
  }
}

TEST(Imager, MagnifiedFieldsGetDoseInProportion) {
  double wide_nGy = 0;
  for (const double field_m : fields_m) {
    Imager imager({}, make_scanline_renderer());
    const Scene scene = water(0.2);
    View view = small_view();
    view.field_m = field_m;
    const Exposure e = imager.exposure({scene, view, {}, fluoroscopy(), 1});
    if (field_m == fields_m[0]) wide_nGy = e.detector_dose_nGy;
    EXPECT_NEAR(e.detector_dose_nGy * field_m, wide_nGy * fields_m[0], 1e-6 * wide_nGy) << field_m;
    EXPECT_GT(e.kerma_Gy, 0) << field_m;
  }
}

TEST(Imager, ABlurAsWideAsThePictureKeepsWhatIsEven) {
  for (const double sigma : {10.0, 22.0, 23.0, 60.0}) {  // the two formulas meet at 22.4
    Plane even = Plane::Constant(32, 32, 2), scratch;
    gaussian_blur(even, sigma, Beyond::same, scratch);
    EXPECT_LT((even - 2).abs().maxCoeff(), 1e-4) << sigma;
    Plane dot = Plane::Zero(32, 32);
    dot(16, 16) = 1;
    gaussian_blur(dot, sigma, Beyond::zero, scratch);
    EXPECT_NEAR(dot(16, 16) * 2 * units::pi * sigma * sigma, 1, 5e-3) << sigma;
  }
}

TEST(Imager, ScatterIsAsMuchAsPrimaryBehindTheMediastinum) {
  // Even with a grid, scatter behind the spine in an AP view is comparable to the primary, within a factor of two.
  const Scene scene = phantom::chest({});
  PathLengths lengths(128);
  View view;
  view.pixels = 128;
  const auto renderer = make_scanline_renderer();
  renderer->add(view, *scene.fixed, lengths);
  renderer->add(view, scene.moving, lengths);
  const Beam beam = make_beam({80, 3, 0.4}, {});
  Primary primary;
  attenuate(beam, ray_stretch(view), lengths, ShaftLayer(128), primary);
  Plane scattered;
  scatter({primary.signal_keV, beam.open_keV(), beam.hardened_soft_1_m, view.field_m}, {}, scattered);
  const Plane ratio = scattered / primary.signal_keV;
  const float spine = ratio.middleCols(28, 24).mean(), left_lung = ratio.block(0, 90, 30, 30).mean();
  EXPECT_GT(spine, 0.5f);
  EXPECT_LT(spine, 2.0f);
  EXPECT_LT(left_lung, 0.1f);
}

}  // namespace
}  // namespace ostium::fluoro
