#pragma once
/// The centreline-sphere tree: spheres fitted into the lumen, grouped in branches (P. Korzeniowski's thesis, 2015,
/// 5.3.4.3). Flow, contrast and measuring go along it.
#include <string>
#include <vector>

#include "vascular/anatomy/lesion.h"
#include "vascular/beat/moving_lumen.h"

namespace ostium {

struct TreeSphere {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();  ///< patient frame, metres
  double radius_m = 0;                          ///< the largest sphere about p in the lumen
  double s_m = 0;                               ///< arc length from the branch's first sphere
};

struct TreeBranch {
  std::string name;
  int parent = -1;         ///< branch that it comes out of, less than its own; -1: a root
  int parent_sphere = -1;  ///< of the parent's, the one nearest to its first
  std::vector<TreeSphere> spheres;
};

struct SphereTree {
  std::vector<TreeBranch> branches;
  std::size_t spheres() const;
};

/// One branch each of the anatomy's names, its spheres every half radius, on the lesions' own centreline; radii from
/// the surface. `wall` is at end-diastole.
SphereTree tree_of(const Anatomy& anatomy, const std::vector<Lesion>& lesions, const Mesh& wall);

/// Radii from another surface: of a frame that was given, whose sections need not be those of the first.
void fit_radii(SphereTree& tree, const Mesh& wall);

/// The same tree in a frame of the beat: centres carried along, radii kept (sections do not change).
SphereTree carried(const SphereTree& tree, const Anatomy& anatomy, const TubeMotion& motion, int frame);

/// [branch][sphere] Displacement of each at the top of a breath, m.
std::vector<std::vector<Eigen::Vector3d>> breath_of(const SphereTree& tree, const Anatomy& anatomy,
                                                    const HeartMotion& heart, const TubeMotion& tubes);

}  // namespace ostium
