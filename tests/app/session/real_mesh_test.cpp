/// A wire through other people's meshes, however untidy; skipped if the meshes are absent.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "app/session/run/play.h"
#include "data/catalogue/catalogue.h"

namespace ostium::app {
namespace {

namespace fs = std::filesystem;

/// $OSTIUM_GEOMETRY, or shared/geometry beside this checkout; empty if there is none.
fs::path geometry() {
  const char* given = std::getenv("OSTIUM_GEOMETRY");
  const fs::path checkout = fs::path(data::data_folder()).parent_path();
  const fs::path folder = given ? fs::path(given) : checkout.parent_path() / "shared" / "geometry";
  return fs::is_directory(folder) ? folder : fs::path();
}

TEST(RealMesh, AWireGoesUpAnAortaThatFacesInwards) {
  if (geometry().empty()) GTEST_SKIP() << "no shared/geometry beside this checkout, nor OSTIUM_GEOMETRY";
  const std::string script = R"({ "schema": "ostium-script/1", "name": "up", "title": "A test",
    "tools": [ { "name": "wire", "instrument": "j-wire-035-150" } ],
    "steps": [
      { "do": "advance", "tool": "wire", "speed_mm_s": 50, "until": [{ "inserted_mm": 250 }], "timeout_s": 10 },
      { "do": "withdraw", "tool": "wire", "speed_mm_s": 100, "until": [{ "inserted_mm": 50 }], "timeout_s": 10 } ] })";
  RunSetup setup;
  set_vessel((geometry() / "iliac-aorta-arch-coarse.obj").string(), vascular::LengthUnit::millimetre, setup);
  setup.entry = {Eigen::Vector3d(-0.0498, 0.0491, 0.0099),
                 Eigen::Vector3d(-0.0578, 0.04, 0.0135)};  // near the iliac end
  set_script(data::read_script("up.json", script), setup);
  std::string warnings;
  ScriptedRun run(setup, make_vessel(setup, warnings));
  EXPECT_NE(warnings.find("turned round"), std::string::npos);
  PlayOptions options;
  options.recorder.mode = RecordMode::none;
  const PlayReport report = play(run, setup, options);
  EXPECT_EQ(report.outcome, "success") << report.reason;
  EXPECT_LT(report.penetration.deepest_m, 0.05e-3) << "also where the J springs past a ridge of this coarse mesh";
  EXPECT_EQ(report.penetration.outside, 0);
}

}  // namespace
}  // namespace ostium::app
