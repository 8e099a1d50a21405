#pragma once
/// The centreline-sphere tree of an anatomy, and how it beats and breathes.
#include "vascular/anatomy/lesion.h"
#include "vascular/geometry/centreline/sphere_tree.h"
#include "vascular/geometry/mesh/mesh.h"
#include "vascular/motion/tube_motion.h"

namespace ostium::vascular {

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

}  // namespace ostium::vascular
