/// OpenVDB's part of the level set (openvdb_module.h).
#include "vascular/geometry/remesh/openvdb_module.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/MeshToVolume.h>
#include <openvdb/tools/SignedFloodFill.h>
#include <openvdb/tools/VolumeToMesh.h>
#include <openvdb/tree/LeafManager.h>

#include <cmath>

namespace ostium::vascular {

namespace {

constexpr float band = 3;  // voxels to each side

using Leaf = openvdb::FloatTree::LeafNodeType;

/// Two neighbouring voxels can only be on different sides of the wall if their distances to it add up to no more than
/// their spacing, so one winding number serves many voxels.
void set_signs(Leaf& leaf, const Inside& is_inside) {
  constexpr int n = static_cast<int>(Leaf::DIM), size = n * n * n;
  constexpr float slack = 1.02F;
  std::array<bool, size> done{};
  std::vector<int> open;
  for (auto value = leaf.cbeginValueOn(); value; ++value) {
    const int seed = static_cast<int>(value.pos());
    if (done[seed]) continue;
    const openvdb::Coord at = value.getCoord();
    const bool inside = is_inside({at.x(), at.y(), at.z()});
    open = {seed};
    done[seed] = true;
    while (!open.empty()) {
      const int i = open.back();
      open.pop_back();
      const float d = leaf.getValue(static_cast<openvdb::Index>(i));
      const openvdb::Coord here = Leaf::offsetToLocalCoord(static_cast<openvdb::Index>(i));
      for (int axis = 0; axis < 3; ++axis)
        for (int step : {-1, 1}) {
          openvdb::Coord next = here;
          next[axis] += step;
          if (next[axis] < 0 || next[axis] >= n) continue;
          const int j = static_cast<int>(Leaf::coordToOffset(next));
          if (done[j] || !leaf.isValueOn(static_cast<openvdb::Index>(j)) ||
              std::fabs(d) + leaf.getValue(static_cast<openvdb::Index>(j)) <= slack)
            continue;
          done[j] = true;
          open.push_back(j);
        }
      if (inside) leaf.setValueOnly(static_cast<openvdb::Index>(i), -d);
    }
  }
}

}  // namespace

ContouredSurface ostium_contour(const std::vector<Eigen::Vector3f>& corners,
                                const std::vector<std::array<int, 3>>& wall, const Inside& is_inside) {
  openvdb::initialize();
  // With these very types OpenVDB's functions are in its library, and need not be compiled here.
  std::vector<openvdb::Vec3s> vertices;
  vertices.reserve(corners.size());
  for (const Eigen::Vector3f& p : corners) vertices.emplace_back(p.x(), p.y(), p.z());
  std::vector<openvdb::Vec3I> faces;
  faces.reserve(wall.size());
  for (const auto& t : wall)
    faces.emplace_back(static_cast<unsigned>(t[0]), static_cast<unsigned>(t[1]), static_cast<unsigned>(t[2]));
  openvdb::util::NullInterrupter never;
  const auto grid = openvdb::tools::meshToVolume<openvdb::FloatGrid>(
      never, openvdb::tools::QuadAndTriangleDataAdapter<openvdb::Vec3s, openvdb::Vec3I>(vertices, faces),
      *openvdb::math::Transform::createLinearTransform(1.0), band, band, openvdb::tools::UNSIGNED_DISTANCE_FIELD,
      nullptr);
  openvdb::tree::LeafManager<openvdb::FloatTree> leaves(grid->tree());
  leaves.foreach ([&](Leaf& leaf, std::size_t) { set_signs(leaf, is_inside); });
  openvdb::tools::signedFloodFill(grid->tree());

  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec3I> triangles;
  std::vector<openvdb::Vec4I> quads;
  openvdb::tools::volumeToMesh(*grid, points, triangles, quads, 0.0, 0.0);
  ContouredSurface out;
  out.points.reserve(points.size()), out.triangles.reserve(triangles.size()), out.quads.reserve(quads.size());
  for (const openvdb::Vec3s& p : points) out.points.emplace_back(p.x(), p.y(), p.z());
  for (const openvdb::Vec3I& t : triangles) out.triangles.push_back({t[0], t[1], t[2]});
  for (const openvdb::Vec4I& q : quads) out.quads.push_back({q[0], q[1], q[2], q[3]});
  return out;
}

}  // namespace ostium::vascular
