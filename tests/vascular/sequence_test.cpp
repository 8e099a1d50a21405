/// A lumen given frame by frame: our own cardiac motion, returned as surfaces only, moves tree and lesions like the
/// motion that made it.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "core/base/units.h"
#include "vascular/geometry/mesh/bounding_volume_hierarchy.h"
#include "vascular/motion/frame_order.h"
#include "vascular/patient/patient.h"

namespace ostium::vascular {
namespace {

TEST(Sequence, OurOwnBeatComesBackFromItsSurfaces) {
  const Patient ours = make_patient({}, {});
  std::vector<std::vector<Eigen::Vector3d>> frames;
  for (int f = 0; f < beat_frames; ++f)
    frames.push_back(ours.lumen.at(static_cast<double>(f) / beat_frames, 0).vertices);
  const Lesion lesion = typical(LesionType::A, "RCA", 42e-3);
  const Patient theirs =
      make_patient(ours.anatomy, {.vertices = frames[0], .triangles = ours.lumen.triangles}, {lesion}, frames);
  EXPECT_FALSE(theirs.lumen.narrowed.empty());
  EXPECT_NEAR(static_cast<double>(theirs.lumen.moving), static_cast<double>(ours.lumen.moving),
              0.02 * static_cast<double>(ours.lumen.moving));

  ASSERT_EQ(theirs.tree.branches.size(), ours.tree.branches.size());
  double off_m = 0, radius_off_m = 0, narrowest = 1;
  for (int f : {0, 5, 9, 14, 20}) {
    const Mesh healthy = theirs.lumen.at(static_cast<double>(f) / beat_frames, 0, 1),
               diseased = theirs.lumen.at(static_cast<double>(f) / beat_frames, 0);
    EXPECT_NEAR(volume_m3(healthy), volume_m3(ours.lumen.at(static_cast<double>(f) / beat_frames, 0)), 1e-9);
    const BoundingVolumeHierarchy wall(diseased);
    for (std::size_t b = 0; b < ours.tree.branches.size(); ++b)
      for (std::size_t s = 0; s < theirs.tree.branches[b].spheres.size(); ++s) {
        const TreeSphere& sphere = theirs.tree_frames[f].branches[b].spheres[s];
        radius_off_m = std::max(radius_off_m, std::fabs(wall.nearest(sphere.p, 0.05).distance_m - sphere.radius_m));
        if (ours.tree.branches[b].name == "RCA")
          narrowest = std::min(narrowest, sphere.radius_m / theirs.tree.branches[b].spheres.front().radius_m);
        if (theirs.tree.branches[b].spheres.size() != ours.tree.branches[b].spheres.size()) continue;
        off_m = std::max(off_m, (sphere.p - ours.tree_frames[f].branches[b].spheres[s].p).norm());
      }
  }
  EXPECT_LT(radius_off_m, 0.1e-3);
  EXPECT_LT(off_m, 0.3e-3) << "centres go up to 25 mm";
  EXPECT_LT(narrowest, 0.6) << "the lesion";
}

TEST(Sequence, FramesThatAreNoWholeBeatAreDoubted) {
  constexpr int count = 24;
  const auto doubts = [](const std::vector<int>& order, const std::vector<int>& numbers = {}) {
    std::vector<Mesh> frames;
    std::vector<std::string> files;
    for (std::size_t i = 0; i < order.size(); ++i) {
      frames.push_back(
          {{10 * units::mm * (1 - std::cos(2 * units::pi * order[i] / count)) * Eigen::Vector3d::UnitX()}, {}});
      files.push_back("f" + std::to_string(numbers.empty() ? order[i] : numbers[i]) + ".obj");
    }
    std::string all;
    for (const std::string& doubt : doubts_of_frames(frames, files)) all += doubt + "\n";
    return all;
  };
  std::vector<int> beat(count), late, half, gap, by_name;
  std::iota(beat.begin(), beat.end(), 0);
  for (int f = 0; f < count; ++f) {
    late.push_back((f + 9) % count);
    if (f < count / 2) half.push_back(f);
    if (f != 7) gap.push_back(f);
  }
  by_name = beat;
  std::sort(by_name.begin(), by_name.end(), [](int a, int b) { return std::to_string(a) < std::to_string(b); });
  EXPECT_EQ(doubts(beat), "");
  EXPECT_EQ(doubts(late), "") << "another moment first, as after the R wave";
  EXPECT_EQ(doubts({0, 3, 6, 9, 12, 15, 18, 21}), "");
  EXPECT_NE(doubts(by_name).find("jump about, as f10.obj follows f1.obj"), std::string::npos);
  EXPECT_NE(doubts(gap).find("between f6.obj and f8.obj a frame is missing"), std::string::npos);
  EXPECT_NE(doubts(half).find("from f11.obj to the first, f0.obj it moves by 19.7 mm"), std::string::npos)
      << doubts(half);
  beat.push_back(0);
  std::vector<int> numbers(beat.size());
  std::iota(numbers.begin(), numbers.end(), 0);
  EXPECT_EQ(doubts(beat, numbers), "f24.obj and f0.obj are the same frame; expected each moment once\n");
  EXPECT_NE(doubts({3, 3, 3, 3, 3}).find("nothing beats"), std::string::npos);
}

TEST(Sequence, OfAnotherNumberOfFramesIsResampled) {
  std::vector<std::vector<Eigen::Vector3d>> few(8);
  for (int f = 0; f < 8; ++f)
    few[f] = {0.01 * Eigen::Vector3d(std::cos(units::pi * f / 4), std::sin(units::pi * f / 4), 3)};
  const auto many = resampled(few, beat_frames);
  ASSERT_EQ(static_cast<int>(many.size()), beat_frames);
  EXPECT_EQ(many[0][0], few[0][0]) << "the first is kept to the bit";
  for (int f = 0; f < beat_frames; ++f) {
    const Eigen::Vector3d there = 0.01 * Eigen::Vector3d(std::cos(units::pi * f / 12), std::sin(units::pi * f / 12), 3);
    EXPECT_LT((many[f][0] - there).norm(), 0.01 * std::pow(units::pi / 4, 4) / 300) << "a cubic spline's error";
  }
  EXPECT_EQ(resampled(few, 8), few);
}

}  // namespace
}  // namespace ostium::vascular
