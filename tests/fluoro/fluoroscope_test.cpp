#include "fluoro/console/fluoroscope.h"

#include <gtest/gtest.h>

#include "fluoro/display/overlay.h"
#include "fluoro/matter/tissue.h"
#include "fluoro/phantom/shapes.h"
#include "fluoro/projection/views.h"

namespace ostium::fluoro {
namespace {

struct Room {
  Scene scene;
  Imager imager{{}, make_scanline_renderer()};
  FluoroscopeState state;
  DisplayScratch scratch;
  View view;

  Room() {
    auto bodies = std::make_shared<std::vector<Body>>();
    bodies->push_back(phantom::body("water", phantom::brick({-0.2, -0.2, -0.1}, {0.2, 0.2, 0.1}), tissue::soft, {}));
    scene.fixed = bodies;
    view.pixels = 128;
  }
  TickReport tick(Pedals pedals, double phase = 0, bool roadmap = false) {
    return fluoro::tick(imager,
                        {.scene = scene,
                         .view = view,
                         .collimator = {},
                         .pedals = pedals,
                         .beat_phase = phase,
                         .show_roadmap = roadmap},
                        state, scratch);
  }
  void add_vessel(float x) {
    Eigen::Matrix3Xd line(3, 2);
    line << x, x, -0.05, 0.05, 0, 0;
    const Eigen::Matrix3Xd fine = phantom::smooth_line({line.col(0), line.col(1)}, 0.001);
    Body vessel = phantom::body("vessel", phantom::tube(fine, Eigen::VectorXd::Constant(fine.cols(), 0.002), 16),
                                tissue::soft, tissue::soft);
    vessel.contrast = {Eigen::VectorXf::Constant(vessel.p_P.cols(), 300), phantom::tube_centres(fine, 16)};
    scene.moving = {vessel};
  }
};

constexpr Pedals fluoro{.fluoroscopy = true}, record{.cine = true};

TEST(Fluoroscope, TheLastImageIsHeldAsTheLagFilterLeftIt) {
  Room room;
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(room.tick(fluoro).xray_on);
  const Picture last = room.state.live;
  const DoseMeter dose = room.state.dose;
  EXPECT_FALSE(room.tick({}).xray_on);
  EXPECT_EQ(room.state.live.grey, last.grey);
  EXPECT_EQ(room.state.dose.kerma_Gy, dose.kerma_Gy);
  EXPECT_NEAR(dose.fluoroscopy_s, 4 / 15.0, 1e-12);
  room.tick(fluoro);
  EXPECT_NE(room.state.live.grey, last.grey);
}

TEST(Fluoroscope, CineRunsAreKeptAndCountApart) {
  Room room;
  for (int i = 0; i < 3; ++i) room.tick(record);
  room.tick({});
  for (int i = 0; i < 2; ++i) room.tick(record);
  room.tick(fluoro);
  ASSERT_EQ(room.state.runs.size(), 2u);
  EXPECT_EQ(room.state.runs[0].frames.size(), 3u);
  EXPECT_EQ(room.state.runs[1].frames.size(), 2u);
  EXPECT_EQ(room.state.dose.cine_frames, 5);
  EXPECT_EQ(room.state.dose.cine_runs, 2);
  EXPECT_NEAR(room.state.dose.fluoroscopy_s, 1 / 15.0, 1e-12);
}

TEST(Fluoroscope, CineCostsMoreAndIsLessNoisy) {
  Room room;
  const Exposure low = room.tick(fluoro).frame.exposure, high = room.tick(record).frame.exposure;
  EXPECT_NEAR(high.detector_dose_nGy / low.detector_dose_nGy, 10, 1e-6);
  EXPECT_GT(high.kerma_Gy, 6 * low.kerma_Gy);
}

TEST(Fluoroscope, WhatCannotBeIsRefusedBeforeAnythingChanges) {
  Room room;
  room.tick(fluoro);
  const auto frame = room.state.imager.frame;
  room.view.arm.lao_rad = 3;
  EXPECT_THROW(room.tick(record), std::invalid_argument);
  room.view.arm.lao_rad = 0;
  room.view.arm.source_to_detector_m = 2;
  EXPECT_THROW(room.tick(record), std::invalid_argument);
  EXPECT_EQ(room.state.imager.frame, frame);
  EXPECT_TRUE(room.state.runs.empty());
}

TEST(Fluoroscope, TheReferenceStaysWhileThePictureGoesOn) {
  Room room;
  room.tick(fluoro);
  freeze_reference(room.state);
  const auto kept = room.state.reference->grey;
  room.tick(fluoro);
  EXPECT_EQ(room.state.reference->grey, kept);
  EXPECT_NE(room.state.live.grey, kept);
}

TEST(Fluoroscope, TheRoadmapShowsTheVesselOfTheSameMomentOfTheBeat) {
  Room room;
  const int first = 52, second = 76;  // columns of the vessel at the two moments
  const auto x_of = [&](int column) { return float((column + 0.5 - 64) * 0.2 / 128 * 0.765 / 1.1); };
  for (double phase : {0.1, 0.6}) room.tick(record, phase);  // masks
  room.add_vessel(x_of(first));
  room.tick(record, 0.1);
  room.add_vessel(x_of(second));
  room.tick(record, 0.6);
  room.scene.moving.clear();
  const auto darkest = [&](double phase) {
    for (int i = 0; i < 6; ++i) room.tick(fluoro, phase, true);
    int best = 0;
    double least = 1e9;
    for (int column = 20; column < 108; ++column) {
      double sum = 0;
      for (int row = 50; row < 78; ++row) sum += room.state.live.grey[std::size_t(row * 128 + column)];
      if (sum < least) least = sum, best = column;
    }
    return best;
  };
  EXPECT_NEAR(darkest(0.1), first, 1);
  EXPECT_NEAR(darkest(0.6), second, 1);
}

TEST(Views, AnglesAreNamedAsInTheCathLab) {
  EXPECT_EQ(angles_text(45, -30), "LAO 45 CAU 30");
  EXPECT_EQ(angles_text(-30, 0), "RAO 30");
  EXPECT_EQ(angles_text(0, 30), "AP CRA 30");
  EXPECT_EQ(angles_text(0.2, -0.3), "AP");
  for (const StandardView& view : standard_views()) {
    EXPECT_NO_THROW(require_reachable({.lao_rad = view.lao_deg * 0.01745, .cran_rad = view.cran_deg * 0.01745}));
    EXPECT_EQ(find_view(view.name)->shows, view.shows);
  }
  EXPECT_FALSE(find_view("upwards"));
}

TEST(Overlay, LettersAndStripsLeaveTheRestAlone) {
  Picture picture{256, 256, std::vector<std::uint8_t>(256 * 256, 100)};
  draw_overlay(
      {.view = {}, .programme = cine(), .exposure = {}, .dose = {}, .xray_on = true, .state = "", .patient = ""},
      picture);
  const auto changed = std::count_if(picture.grey.begin(), picture.grey.end(), [](int g) { return g != 100; });
  EXPECT_GT(changed, 200);
  EXPECT_EQ(picture.grey[128 * 256 + 128], 100);
  std::vector<float> square(500);
  for (std::size_t i = 0; i < square.size(); ++i) square[i] = i < 250 ? 0.f : 1.f;
  append_strips({{"II", "mV", 250, square, 0, 1}}, 2, 100, picture);
  EXPECT_EQ(picture.height, 356);
  EXPECT_EQ(picture.grey.size(), 256u * 356u);
  // Low values in the older half, high ones in the newer half.
  const auto bright = [&](int column, int from, int to) {
    int most = 0;
    for (int row = from; row < to; ++row)
      most = std::max(most, int(picture.grey[std::size_t((256 + row) * 256 + column)]));
    return most;
  };
  EXPECT_GT(bright(90, 80, 100), 150);
  EXPECT_GT(bright(160, 0, 20), 150);
}

}  // namespace
}  // namespace ostium::fluoro
