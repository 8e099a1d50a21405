/// A lumen given frame by frame: our own cardiac motion, returned as surfaces only, moves tree and lesions like the
/// motion that made it.
#include <gtest/gtest.h>

#include "core/base/units.h"
#include "vascular/geometry/mesh/bounding_volume_hierarchy.h"
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
