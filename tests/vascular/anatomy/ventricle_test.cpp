/// The ventricle behind the valve: with it the wall is one closed surface, with a door inside.
#include "vascular/patient/ventricle.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <set>

#include "vascular/geometry/mesh/surface_check.h"
#include "vascular/motion/heart_cycle.h"
#include "vascular/patient/wall.h"

namespace ostium::vascular {
namespace {

using Eigen::Vector3d;

/// The surface without its door in a frame, as contact sees it while the door is open.
Mesh without_door(const core::SurfaceDescription& wall, int frame) {
  const std::set<int> door(wall.door.begin(), wall.door.end());
  Mesh mesh{.vertices = wall.frames[static_cast<std::size_t>(frame)], .triangles = {}};
  for (int t = 0; t < static_cast<int>(wall.triangles.size()); ++t)
    if (!door.contains(t)) mesh.triangles.push_back(wall.triangles[static_cast<std::size_t>(t)]);
  // Drop vertices that belong to the door alone.
  std::vector<int> number(mesh.vertices.size(), -1);
  Mesh out;
  for (auto& t : mesh.triangles)
    for (int& v : t) {
      if (number[static_cast<std::size_t>(v)] < 0)
        number[static_cast<std::size_t>(v)] = static_cast<int>(out.vertices.size()),
        out.vertices.push_back(mesh.vertices[static_cast<std::size_t>(v)]);
      v = number[static_cast<std::size_t>(v)];
    }
  out.triangles = mesh.triangles;
  return out;
}

class VentricleOf : public testing::TestWithParam<int> {};

TEST_P(VentricleOf, IsOneClosedSurfaceWithTheLumenThroughoutTheBeat) {
  const Patient patient =
      make_patient(GetParam() == 0 ? AnatomyParameters{} : person(static_cast<std::uint64_t>(GetParam()), {}), {});
  core::SurfaceDescription wall = wall_of(patient.lumen);
  const std::size_t triangles = wall.triangles.size();
  const double lumen_m3 = volume_m3({wall.frames[0], wall.triangles});
  const Ventricle ventricle = add_ventricle(patient, wall);
  ASSERT_FALSE(ventricle.spheres.empty());
  ASSERT_GT(wall.door.size(), 10U);
  const int systole = static_cast<int>(std::lround(end_systole * beat_frames));
  double volume[2] = {};
  for (int k = 0; k < 2; ++k) {
    const SurfaceReport before =
        check_surface({{wall.frames[k ? systole : 0].begin(),
                        wall.frames[k ? systole : 0].begin() + static_cast<std::ptrdiff_t>(patient.lumen.vertices())},
                       {wall.triangles.begin(), wall.triangles.begin() + static_cast<std::ptrdiff_t>(triangles)}});
    const Mesh mesh = without_door(wall, k ? systole : 0);
    const SurfaceReport r = check_surface(mesh);
    EXPECT_TRUE(r.closed()) << describe(r);
    EXPECT_EQ(r.components, 1);
    EXPECT_EQ(r.inverted.count, 0);
    EXPECT_EQ(r.crossings.count, before.crossings.count) << describe(r);
    EXPECT_EQ(r.vertices - r.triangles / 2, 2) << "no handle";
    volume[k] = volume_m3(mesh) - lumen_m3;
  }
  // A healthy ventricle has 128 mL and more at end-diastole; a simple one without its base has less. It contracts.
  EXPECT_GT(volume[0], 50e-6);
  EXPECT_LT(volume[0], 140e-6);
  EXPECT_LT(volume[1], volume[0]);
  // Clear of the arteries by some millimetres of muscle.
  double nearest = 1;
  for (std::size_t f = 0; f < wall.frames.size(); f += 8)
    for (const TreeBranch& b : patient.tree_frames[f].branches)
      if (b.name != "aorta" && b.name.find("sinus") == std::string::npos)
        for (const TreeSphere& s : b.spheres)
          for (std::size_t v = patient.lumen.vertices(); v < wall.frames[f].size(); ++v)
            nearest = std::min(nearest, (wall.frames[f][v] - s.p).norm() - s.radius_m);
  EXPECT_GT(nearest, 2e-3);
}
INSTANTIATE_TEST_SUITE_P(People, VentricleOf, testing::Values(0, 3));

TEST(Ventricle, OfAMeshWithoutAFloorThereIsNone) {
  Patient patient = make_patient(AnatomyParameters{}, {});
  core::SurfaceDescription wall = wall_of(patient.lumen);
  const std::size_t triangles = wall.triangles.size();
  patient.anatomy.landmarks.p_annulus += 0.05 * patient.anatomy.landmarks.root_axis;
  EXPECT_TRUE(add_ventricle(patient, wall).spheres.empty());
  EXPECT_EQ(wall.triangles.size(), triangles);
  EXPECT_TRUE(wall.door.empty());
}

}  // namespace
}  // namespace ostium::vascular
