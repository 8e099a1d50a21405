#pragma once
/// From a row of voxels to the spheres of a branch: in the middle of the lumen, from lid to lid.
#include <vector>

#include "vascular/geometry/centreline/sphere_tree.h"
#include "vascular/geometry/mesh/bounding_volume_hierarchy.h"

namespace ostium::vascular {

/// Smooths the line, and moves each point across it to where its sphere is largest. Both ends stay.
std::vector<TreeSphere> fitted_spheres(std::vector<Eigen::Vector3d> line, const BoundingVolumeHierarchy& wall,
                                       double voxel_m);

/// The last spheres of a vessel lean towards the rim of its lid and are as narrow as they are near to it. Replaces
/// them: the line goes on in the middle of the lumen to the lid, with radii from where the lid is no nearer than the
/// wall around. A line that ends more than `beyond` radii before a lid, as at a picked point, is left alone, and
/// one shorter than the lid's reach only loses its tip.
void carry_to_lid(std::vector<TreeSphere>& spheres, const BoundingVolumeHierarchy& wall, double beyond = 1);

/// Removes spheres at the tip that shrink much faster than a vessel tapers, from one to the next by less than `least`
/// of the radius: the line then ends inside the lumen.
void trim(std::vector<TreeSphere>& spheres, double least = 0.75);

/// Last sphere first.
void turn_round(std::vector<TreeSphere>& spheres);

}  // namespace ostium::vascular
