#include "vascular/geometry/remesh/level_set.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/MeshToVolume.h>
#include <openvdb/tools/SignedFloodFill.h>
#include <openvdb/tools/VolumeToMesh.h>
#include <openvdb/tree/LeafManager.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "vascular/geometry/remesh/winding.h"

namespace ostium::vascular {

namespace {

constexpr float band = 3;  // voxels to each side
constexpr std::size_t most_sampled = 400'000;

/// Triangles that border on the outside; those inside another piece would spoil distances.
std::vector<std::array<int, 3>> bordering(const Mesh& mesh, const WindingNumber& winding, double step_m) {
  if (mesh.triangles.size() > most_sampled) return mesh.triangles;
  std::vector<std::array<int, 3>> kept;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    const Eigen::Vector3d area = (b - a).cross(c - a);
    if (area.isZero(0)) continue;
    const Eigen::Vector3d out = step_m * area.normalized();
    bool borders = false;
    for (const Eigen::Vector3d& w :
         {Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(8, 1, 1), Eigen::Vector3d(1, 8, 1), Eigen::Vector3d(1, 1, 8)}) {
      const Eigen::Vector3d p = (w[0] * a + w[1] * b + w[2] * c) / w.sum();
      borders = winding.inside(p - out) != winding.inside(p + out);
      if (borders) break;
    }
    if (borders) kept.push_back(t);
  }
  return kept;
}

using Leaf = openvdb::FloatTree::LeafNodeType;

/// Two neighbouring voxels can only be on different sides of the wall if their distances to it add up to no more than
/// their spacing, so one winding number serves many voxels.
void set_signs(Leaf& leaf, const WindingNumber& winding, const Eigen::Vector3d& origin, double voxel_m) {
  constexpr int n = static_cast<int>(Leaf::DIM), size = n * n * n;
  constexpr float slack = 1.02F;
  std::array<bool, size> done{};
  std::vector<int> open;
  for (auto value = leaf.cbeginValueOn(); value; ++value) {
    const int seed = static_cast<int>(value.pos());
    if (done[seed]) continue;
    const openvdb::Coord at = value.getCoord();
    const bool inside = winding.inside(origin + voxel_m * Eigen::Vector3d(at.x(), at.y(), at.z()));
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

std::vector<std::array<int, 3>> bordering_triangles(const Mesh& closed, double step_m) {
  return bordering(closed, WindingNumber(closed), step_m);
}

Mesh outer_surface(const Mesh& closed, double voxel_m) {
  openvdb::initialize();
  const WindingNumber winding(closed);
  const std::vector<std::array<int, 3>> wall = bordering(closed, winding, voxel_m / 20);
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : closed.vertices) box.extend(p);
  // Offset from the round numbers at which people place vertices and flat ends.
  const Eigen::Vector3d origin = box.min() - voxel_m * Eigen::Vector3d(0.137, 0.271, 0.313);
  // With these very types OpenVDB's functions are in its library, and need not be compiled here.
  std::vector<openvdb::Vec3s> corners;
  corners.reserve(closed.vertices.size());
  for (const Eigen::Vector3d& p : closed.vertices) {
    const Eigen::Vector3f at = ((p - origin) / voxel_m).cast<float>();
    corners.emplace_back(at.x(), at.y(), at.z());
  }
  std::vector<openvdb::Vec3I> faces;
  faces.reserve(wall.size());
  for (const auto& t : wall)
    faces.emplace_back(static_cast<unsigned>(t[0]), static_cast<unsigned>(t[1]), static_cast<unsigned>(t[2]));
  openvdb::util::NullInterrupter never;
  const auto grid = openvdb::tools::meshToVolume<openvdb::FloatGrid>(
      never, openvdb::tools::QuadAndTriangleDataAdapter<openvdb::Vec3s, openvdb::Vec3I>(corners, faces),
      *openvdb::math::Transform::createLinearTransform(1.0), band, band, openvdb::tools::UNSIGNED_DISTANCE_FIELD,
      nullptr);
  openvdb::tree::LeafManager<openvdb::FloatTree> leaves(grid->tree());
  leaves.foreach ([&](Leaf& leaf, std::size_t) { set_signs(leaf, winding, origin, voxel_m); });
  openvdb::tools::signedFloodFill(grid->tree());

  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec3I> triangles;
  std::vector<openvdb::Vec4I> quads;
  openvdb::tools::volumeToMesh(*grid, points, triangles, quads, 0.0, 0.0);
  Mesh mesh;
  mesh.vertices.reserve(points.size());
  for (const openvdb::Vec3s& p : points)
    mesh.vertices.push_back(origin + voxel_m * Eigen::Vector3d(p.x(), p.y(), p.z()));
  mesh.triangles.reserve(triangles.size() + 2 * quads.size());
  const auto add = [&](unsigned a, unsigned b, unsigned c) {
    mesh.triangles.push_back({static_cast<int>(a), static_cast<int>(b), static_cast<int>(c)});
  };
  for (const openvdb::Vec3I& t : triangles) add(t[0], t[1], t[2]);
  for (const openvdb::Vec4I& q : quads) {
    const auto length = [&](unsigned a, unsigned b) { return (points[a] - points[b]).lengthSqr(); };
    if (length(q[0], q[2]) <= length(q[1], q[3])) {
      add(q[0], q[1], q[2]);
      add(q[0], q[2], q[3]);
    } else {
      add(q[0], q[1], q[3]);
      add(q[1], q[2], q[3]);
    }
  }
  return mesh;
}

}  // namespace ostium::vascular
