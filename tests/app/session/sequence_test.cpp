/// A case whose lumen is a sequence of meshes: contact, tree and vessel index follow the frames; invalid sequences are
/// refused.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "app/session/model/penetration.h"
#include "app/session/run/run.h"
#include "core/base/units.h"
#include "data/catalogue/case/anatomy_file.h"
#include "data/formats/mesh_writer.h"
#include "tests/app/session/tube_vessel.h"
#include "vascular/anatomy/labelling/labelling.h"
#include "vascular/geometry/mesh_files/written_mesh.h"

namespace ostium::app {
namespace {

namespace fs = std::filesystem;

constexpr int frames = 6;
constexpr double swing_m = 8e-3;

/// Displacement along z of a point of the bent tube in a frame; x and y do not change. The tube's first third is at
/// rest.
double lift_m(double x, double y, int frame) {
  const double along = std::clamp((x + y - 0.1) / 0.1, 0.0, 1.0);
  return swing_m * along * along * (3 - 2 * along) * std::pow(std::sin(units::pi * frame / frames), 2);
}

/// That tube as a case: a folder of its own, in the frame found by vessel labelling.
class Swing {
 public:
  Swing() : folder(fs::temp_directory_path() / ("ostium-sequence-" + std::to_string(getpid())) / "swing") {
    fs::create_directories(folder);
    const vascular::Mesh tube = bent_tube();
    found = label_vessels(tube);
    for (int f = 0; f < frames; ++f) {
      vascular::Mesh mesh = tube;
      for (Eigen::Vector3d& p : mesh.vertices) {
        p.z() += lift_m(p.x(), p.y(), f);
        p = found.R_PF * p - found.shift_P;
      }
      meshes.push_back(as_written(mesh, vascular::LengthUnit::millimetre));
      data::write_mesh((folder / name(f)).string(), meshes.back(), vascular::LengthUnit::millimetre);
    }
    std::ofstream(folder / "anatomy.json") << data::anatomy_to_json(found.anatomy);
    write_case(R"("lumen-01.ply", "lumen-02.ply", "lumen-03.ply", "lumen-04.ply", "lumen-05.ply")");
  }
  ~Swing() { fs::remove_all(folder.parent_path()); }

  static std::string name(int frame) { return "lumen-0" + std::to_string(frame) + ".ply"; }
  void write_case(const std::string& later) const {
    std::ofstream(folder / "swing.json") << R"({ "schema": "ostium-case/1", "name": "swing", "title": "A test",
      "card": { "history": "None.", "ecg": "None.", "planned_access": "Its end." },
      "imported": { "anatomy": "anatomy.json", "lumen": "lumen-00.ply",
                    "frames": [)" << later
                                         << R"(] },
      "heart_rate_1_min": 70, "lesions": [] })";
  }
  std::string refusal() const {
    try {
      data::load_case((folder / "swing.json").string());
    } catch (const data::LoadError& error) {
      return error.what();
    }
    return "accepted";
  }

  fs::path folder;
  vascular::LabelledVessels found;
  std::vector<vascular::Mesh> meshes;
};

TEST(Sequence, TheWallAndTheTreeGoThroughItsFrames) {
  const Swing swing;
  const data::Case c = data::load_case((swing.folder / "swing.json").string());
  const vascular::Patient patient = patient_of(c);
  for (int f = 0; f < frames; ++f) {
    const vascular::Mesh now = patient.lumen.at(static_cast<double>(f) / frames, 0);
    ASSERT_EQ(now.vertices.size(), swing.meshes[f].vertices.size());
    double off = 0;
    // Moving vertices come first: their numbers differ from the file's, but not their positions.
    std::vector<double> there, here;
    for (const Eigen::Vector3d& p : now.vertices) here.push_back(p.x() + 2 * p.y() + 3 * p.z());
    for (const Eigen::Vector3d& p : swing.meshes[f].vertices) there.push_back(p.x() + 2 * p.y() + 3 * p.z());
    std::sort(here.begin(), here.end()), std::sort(there.begin(), there.end());
    for (std::size_t v = 0; v < here.size(); ++v) off = std::max(off, std::fabs(here[v] - there[v]));
    EXPECT_LT(off, 4e-6) << "what moves by less than 1 um rests; frame " << f;
  }
  EXPECT_GT(patient.lumen.moving, 0u);
  EXPECT_LT(patient.lumen.moving, patient.lumen.vertices()) << "its first third rests";

  // Centres of the tree move with the tube.
  const Eigen::Matrix3d back = swing.found.R_PF.transpose();
  double farthest = 0;
  for (std::size_t b = 0; b < patient.tree.branches.size(); ++b)
    for (std::size_t s = 0; s < patient.tree.branches[b].spheres.size(); ++s)
      for (int f = 0; f < frames; ++f) {
        const Eigen::Vector3d rest = patient.tree.branches[b].spheres[s].p,
                              now = patient.tree_frames[f * vascular::beat_frames / frames].branches[b].spheres[s].p;
        const Eigen::Vector3d in_file = back * (rest + swing.found.shift_P);
        const Eigen::Vector3d moved = back * (now - rest);
        EXPECT_NEAR(moved.z(), lift_m(in_file.x(), in_file.y(), f), 0.3e-3) << "a section is carried as one";
        EXPECT_LT(std::hypot(moved.x(), moved.y()), 0.3e-3);
        farthest = std::max(farthest, moved.z());
      }
  EXPECT_GT(farthest, 0.95 * swing_m);
}

TEST(Sequence, AWireGoesWithIt) {
  const Swing swing;
  RunSetup setup;
  set_vessel(swing.folder.string(), vascular::LengthUnit::millimetre, setup);
  set_script(data::read_script("in.json", R"({ "schema": "ostium-script/1", "name": "in", "title": "A test",
    "tools": [ { "name": "wire", "instrument": "cook-j" } ],
    "steps": [ { "do": "advance", "tool": "wire", "speed_mm_s": 150, "until": [{ "inserted_mm": 230 }], "timeout_s": 3 },
               { "do": "wait", "until": [{ "beats": 1 }] } ] })"),
             setup);
  std::string warnings;
  ScriptedRun run(setup, make_vessel(setup, warnings));
  double low = 1, high = -1;
  const Eigen::RowVector3d up = swing.found.R_PF.transpose().row(2);
  while (run.tick())
    if (static_cast<int>(run.hands.step) == 1) {
      const double z = up * tip(run.model, run.state, 0);
      low = std::min(low, z), high = std::max(high, z);
    }
  EXPECT_EQ(run.outcome, Outcome::success);
  EXPECT_GT(high - low, 0.5 * swing_m) << "there is room of 8 mm about the wire";
  const Penetration found = penetration(run.model, run.state);
  EXPECT_EQ(found.outside, 0);
  EXPECT_LT(found.deepest_m, 0.05e-3);
}

TEST(Sequence, WhatIsNoneIsRefusedByFileAndCount) {
  const Swing swing;
  swing.write_case(R"("lumen-01.ply", "lumen-02.ply")");
  EXPECT_NE(swing.refusal().find("at least three"), std::string::npos) << swing.refusal();
  swing.write_case(R"("lumen-01.ply", "../lumen-02.ply", "lumen-03.ply", "lumen-04.ply")");
  EXPECT_NE(swing.refusal().find("frames"), std::string::npos) << swing.refusal();

  swing.write_case(R"("lumen-01.ply", "lumen-02.ply", "lumen-03.ply")");
  vascular::Mesh fewer = swing.meshes[2];
  fewer.triangles.pop_back();
  data::write_mesh((swing.folder / Swing::name(2)).string(), fewer, vascular::LengthUnit::millimetre);
  const std::string one_less = std::to_string(fewer.triangles.size());
  EXPECT_NE(swing.refusal().find("lumen-02.ply: has " + one_less + " triangles"), std::string::npos) << swing.refusal();

  vascular::Mesh mixed = swing.meshes[2];
  std::swap(mixed.triangles[10], mixed.triangles[500]);
  data::write_mesh((swing.folder / Swing::name(2)).string(), mixed, vascular::LengthUnit::millimetre);
  EXPECT_NE(swing.refusal().find("lumen-02.ply: "), std::string::npos) << swing.refusal();
  EXPECT_NE(swing.refusal().find("lie apart"), std::string::npos) << swing.refusal();
}

}  // namespace
}  // namespace ostium::app
