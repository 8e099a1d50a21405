/// Pictures of a session: the steps they fall on, their content, and the mode that sets their dose.
#include "app/session/scene/film.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <thread>
#include <vector>

#include "app/session/run/filming.h"
#include "app/session/run/run.h"
#include "app/session/scene/xray_scene.h"
#include "data/catalogue/catalogue.h"
#include "tests/app/session/tube_vessel.h"
#include "tests/support/renderers.h"

namespace ostium::fluoro {

INSTANTIATE_TEST_SUITE_P(Renderers, DrawnBy, testing::Values(Renderer::osmesa, Renderer::egl), name_of);

}  // namespace ostium::fluoro

namespace ostium::app {
namespace {

using fluoro::DrawnBy;

/// Spread over the folds round it, the same metal is half as dense and twice as wide: marks are then hardly seen.
TEST(Film, AMarkerBandIsSolidAndAsWideAsItsTube) {
  for (const char* name : {"balloon-275x12", "stent-35x18"}) {
    const data::Instrument instrument = data::find_instrument(data::load_catalogue(), name);
    int bands = 0;
    for (const fluoro::OpaqueSection& s : sections_of(instrument)) {
      if (s.material != fluoro::Material::platinum) continue;
      ++bands;
      EXPECT_NEAR(s.outer_radius_m, 0.33e-3, 1e-9) << name;
      EXPECT_NEAR(s.inner_radius_m, 0.28e-3, 2e-6) << name << ": on the inner tube of 0.56 mm";
      EXPECT_EQ(s.filling, 1) << name;
      EXPECT_NEAR(s.to_tip_m - s.from_tip_m, 1e-3, 1e-9) << name;
    }
    EXPECT_EQ(bands, 2) << name;
  }
}

TEST(Film, FramesFallOnTheirSteps) {
  for (double rate : {3.75, 7.5, 15.0, 30.0}) {
    std::vector<std::uint64_t> steps;
    for (std::uint64_t s = 1; s <= 4000; ++s)
      if (is_frame(s, rate, 1e-3)) steps.push_back(s);
    ASSERT_EQ(steps.size(), static_cast<std::size_t>(4 * rate));
    for (std::size_t n = 0; n < steps.size(); ++n)
      EXPECT_EQ(steps[n], static_cast<std::uint64_t>(std::llround(1000 * static_cast<double>(n + 1) / rate)));
  }
}

TEST(Film, OfARunShowsTheWireAndIsTheSameTwice) {
  ScriptedRun run(tube_setup(), tube_vessel());
  for (int i = 0; i < 1200; ++i) run.tick();
  FilmOptions options;
  options.pixels = 256;
  options.field_m = 0.3;  // the tube extends beyond 20 cm at the detector
  options.overlay = false;
  Film one(run.model, options), two(run.model, options);
  const fluoro::Picture a = one.frame(run.model, run.state, run.inputs);
  EXPECT_EQ(a.grey, two.frame(run.model, run.state, run.inputs).grey);
  SessionState empty = make_state(run.model, 0);
  Film three(run.model, options);
  const fluoro::Picture without = three.frame(run.model, empty, run.inputs);
  long darker = 0;
  for (std::size_t i = 0; i < a.grey.size(); ++i) darker += a.grey[i] + 8 < without.grey[i];
  EXPECT_GT(darker, 60) << "some 120 mm of a wire of 0.9 mm, on pixels of 1.2 mm, with the same noise";
}

TEST(Film, FollowsThePedalUnlessItIsOfOneMode) {
  ScriptedRun run(tube_setup(), tube_vessel());
  run.tick();
  FilmOptions options;
  options.pixels = 64;
  options.overlay = false;
  const auto mode_of = [&](std::optional<fluoro::Mode> mode, double cine_pedal) {
    options.mode = mode;
    SessionInputs inputs = run.inputs;
    inputs.c_arm.fluoroscopy = 0, inputs.c_arm.cine = cine_pedal;
    Film film(run.model, options);
    film.frame(run.model, run.state, inputs);
    return film.run().programme.mode;
  };
  EXPECT_EQ(mode_of({}, 0), fluoro::Mode::fluoroscopy) << "no pedal";
  EXPECT_EQ(mode_of({}, 1), fluoro::Mode::cine);
  EXPECT_EQ(mode_of(fluoro::Mode::fluoroscopy, 1), fluoro::Mode::fluoroscopy) << "DICOM has one header for all frames";
  EXPECT_EQ(mode_of(fluoro::Mode::cine, 0), fluoro::Mode::cine);
}

TEST(Film, OfAPatientIsTheSameWhateverIsDrawnOnce) {
  // Frames of a beat with what rests drawn once, beside frames of the same scenes in which nothing rests.
  const auto patient =
      std::make_shared<const vascular::Patient>(vascular::make_patient(data::find_case("rca-mid-focal").anatomy, {}));
  const XrayPatient xray(patient, Fill::right);
  fluoro::Imager one({}, fluoro::make_scanline_renderer()), other({}, fluoro::make_scanline_renderer());
  fluoro::ImagerState a, b;
  fluoro::View view;
  view.pixels = 256;
  view.arm.lao_rad = 0.7;
  view.arm.p_PI = heart_middle(*patient);
  for (double phase : {0.0, 0.35, 0.6}) {
    const fluoro::Scene scene = xray.at(phase);
    EXPECT_NO_THROW(check(scene));
    fluoro::Scene whole = scene;
    long still = 0, all = 0;
    for (fluoro::Body& body : whole.moving) still += body.still, all += body.triangles->cols(), body.still = 0;
    EXPECT_GT(still, all / 10);
    const fluoro::FrameReport report = one.frame({scene, view, {}, fluoro::cine(), 1}, a);
    EXPECT_FALSE(report.leak);
    EXPECT_FALSE(other.frame({whole, view, {}, fluoro::cine(), 1}, b).leak);
    EXPECT_EQ(report.exposure.tube, other.exposure({whole, view, {}, fluoro::cine(), 1}).tube);
    // Sums of the same lengths in another order: micrometres of tissue at most, of which 20 um are a thousandth.
    EXPECT_LT(((a.lag.shown - b.lag.shown).abs() / b.lag.shown.max(1.0f)).maxCoeff(), 1e-3f);
  }
}

TEST_P(DrawnBy, OfAPatientIsAsByScanline) {
  const auto patient =
      std::make_shared<const vascular::Patient>(vascular::make_patient(data::find_case("rca-mid-focal").anatomy, {}));
  const XrayPatient xray(patient, Fill::right);
  fluoro::View view;
  view.pixels = 256;
  view.arm.lao_rad = 0.7;
  view.arm.p_PI = heart_middle(*patient);
  const fluoro::Scene scene = xray.at(0.6);
  std::vector<fluoro::Plane> shown;
  for (fluoro::Renderer which : {fluoro::Renderer::scanline, GetParam()}) {
    fluoro::Imager imager({}, fluoro::make_renderer(which));
    fluoro::ImagerState state;
    EXPECT_FALSE(imager.frame({scene, view, {}, fluoro::cine(), 1}, state).leak);
    shown.push_back(state.lag.shown);
  }
  const fluoro::Plane off = (shown[1] / shown[0] - 1).abs();
  EXPECT_LT(off.mean(), 2e-4f);  // 5e-5 seen
  EXPECT_LT(off.maxCoeff(), 0.05f) << "of a pixel on the edge of a rib";
  RecordProperty("mean_share", std::to_string(off.mean()));
  RecordProperty("most_share", std::to_string(off.maxCoeff()));
}

TEST(Filming, ShowsEachPictureToWhoeverWatchesAlsoWhereTheVideoCannotBeWritten) {
  ScriptedRun run(tube_setup(), tube_vessel());
  FilmOptions options;
  options.pixels = 128;
  Film same(run.model, options);
  Filming filming(run.model, "/proc/nowhere/film.mp4", options);
  core::TripleBuffer<Filmed>& pictures = filming.pictures();
  int shown = 0;
  for (; shown < 5; run.tick()) {
    if (!is_frame(run.state.rods.step, options.frames_per_s, run.model.step_s())) continue;
    SessionInputs inputs = run.inputs;
    inputs.c_arm.fluoroscopy = shown % 3 != 2;
    const fluoro::Picture drawn = same.frame(run.model, run.state, inputs, run.xrays);
    EXPECT_EQ(filming.drive(run, inputs), Driven::on);
    for (int wait = 0; wait < 5000 && !pictures.update(); ++wait)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const Filmed& now = pictures.front();
    EXPECT_EQ(now.xray_on, shown % 3 != 2);
    EXPECT_EQ(now.picture.grey, drawn.grey);
    EXPECT_EQ(now.dose.fluoroscopy_s, same.dose().fluoroscopy_s);
    ++shown;
  }
  EXPECT_EQ(shown, 5);
  EXPECT_NE(filming.finish(), "");
}

}  // namespace
}  // namespace ostium::app
