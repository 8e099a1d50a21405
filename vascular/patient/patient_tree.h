#pragma once
/// The centreline-sphere tree of an anatomy, with cardiac and breathing motion.
#include "vascular/anatomy/lesion.h"
#include "vascular/geometry/centreline/sphere_tree.h"
#include "vascular/geometry/mesh/mesh.h"
#include "vascular/motion/tube_motion.h"

namespace ostium::vascular {

/// One branch per name in the anatomy, with a sphere every half radius on the centreline of the diseased lumen; radii
/// from the surface. `wall` is at end-diastole.
SphereTree tree_of(const Anatomy& anatomy, const std::vector<Lesion>& lesions, const Mesh& wall);

/// Takes radii from another surface, a given frame whose cross-sections may differ from the first.
void fit_radii(SphereTree& tree, const Mesh& wall);

/// The same tree in a frame of the cardiac cycle: centres move, radii are kept.
SphereTree carried(const SphereTree& tree, const Anatomy& anatomy, const TubeMotion& motion, int frame);

/// [branch][sphere] Displacements at full inspiration, m.
std::vector<std::vector<Eigen::Vector3d>> breath_of(const SphereTree& tree, const Anatomy& anatomy,
                                                    const HeartMotion& heart, const TubeMotion& tubes);

}  // namespace ostium::vascular
