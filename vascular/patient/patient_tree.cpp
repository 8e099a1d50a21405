#include "vascular/patient/patient_tree.h"

#include <algorithm>
#include <cassert>

#include "vascular/geometry/mesh/bounding_volume_hierarchy.h"

namespace ostium::vascular {

namespace {

/// Spheres of a tube between two arc lengths; radii are set once the wall is known.
std::vector<TreeSphere> along(const Anatomy& anatomy, const std::vector<Lesion>& lesions, int tube, double from,
                              double to) {
  std::vector<TreeSphere> spheres;
  const Tube& t = anatomy.tubes[tube];
  double s = from;
  for (bool last = false; !last;) {
    last = s >= to;
    const TubeNode node = t.at(std::min(s, to));
    const Narrowing narrowing = narrowing_at(anatomy, lesions, tube, node.s_m);
    const Eigen::Vector3d p = node.p + narrowing.shift;
    const double step = spheres.empty() ? 0 : (p - spheres.back().p).norm();
    spheres.push_back({p, narrowing.scale * node.radius_m, spheres.empty() ? 0 : spheres.back().s_m + step});
    s += std::max(0.1e-3, narrowing.scale * node.radius_m / 2);
  }
  return spheres;
}

int nearest_sphere(const TreeBranch& branch, const Eigen::Vector3d& p) {
  const auto nearest = std::min_element(
      branch.spheres.begin(), branch.spheres.end(),
      [&](const TreeSphere& a, const TreeSphere& b) { return (a.p - p).squaredNorm() < (b.p - p).squaredNorm(); });
  return static_cast<int>(nearest - branch.spheres.begin());
}

}  // namespace

SphereTree tree_of(const Anatomy& anatomy, const std::vector<Lesion>& lesions, const Mesh& wall) {
  SphereTree tree;
  for (std::size_t i = 0; i < anatomy.branches.size(); ++i) {
    const NamedBranch& named = anatomy.branches[i];
    const bool goes_on = i > 0 && anatomy.branches[i - 1].tube == named.tube;
    TreeBranch branch{.name = named.name,
                      .spheres = along(anatomy, lesions, named.tube, goes_on ? named.from_m : 0, named.to_m)};
    const int parent_tube = anatomy.tubes[named.tube].parent;
    for (std::size_t b = 0; b < tree.branches.size(); ++b) {
      const int tube = anatomy.branches[b].tube;
      if (tube != (goes_on ? named.tube : parent_tube)) continue;
      const int sphere = nearest_sphere(tree.branches[b], branch.spheres.front().p);
      const auto distance = [&](int at, int s) {
        return (tree.branches[at].spheres[s].p - branch.spheres.front().p).norm();
      };
      if (branch.parent < 0 || distance(static_cast<int>(b), sphere) < distance(branch.parent, branch.parent_sphere))
        branch.parent = static_cast<int>(b), branch.parent_sphere = sphere;
    }
    tree.branches.push_back(std::move(branch));
  }
  fit_radii(tree, wall);
  return tree;
}

void fit_radii(SphereTree& tree, const Mesh& wall) {
  const BoundingVolumeHierarchy surface(wall);
  for (TreeBranch& branch : tree.branches)
    for (TreeSphere& sphere : branch.spheres)
      sphere.radius_m = surface.nearest(sphere.p, 2 * sphere.radius_m + 20e-3).distance_m;
}

SphereTree carried(const SphereTree& tree, const Anatomy& anatomy, const TubeMotion& motion, int frame) {
  SphereTree moved = tree;
  for (std::size_t b = 0; b < tree.branches.size(); ++b) {
    const Tube& tube = anatomy.tubes[anatomy.branches[b].tube];
    for (TreeSphere& sphere : moved.branches[b].spheres)
      sphere.p = motion.carried(sphere.p, {{anatomy.branches[b].tube, nearest_s(tube, sphere.p), 1}}, frame);
  }
  return moved;
}

std::vector<std::vector<Eigen::Vector3d>> breath_of(const SphereTree& tree, const Anatomy& anatomy,
                                                    const HeartMotion& heart, const TubeMotion& tubes) {
  std::vector<std::vector<Eigen::Vector3d>> breath;
  for (std::size_t b = 0; b < tree.branches.size(); ++b) {
    const int tube = anatomy.branches[b].tube;
    breath.emplace_back();
    for (const TreeSphere& sphere : tree.branches[b].spheres)
      breath.back().push_back(tubes.breath_share(tube, nearest_s(anatomy.tubes[tube], sphere.p)) *
                              heart.breath_displacement(sphere.p, 1));
  }
  return breath;
}

}  // namespace ostium::vascular
