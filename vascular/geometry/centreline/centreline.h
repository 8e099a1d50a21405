#pragma once
/// The centreline-sphere tree of any closed mesh: automatic, or from a start, ends and points to pass that a user
/// picked.
///
/// Voxels inside the mesh carry their distance to the wall; cheapest paths from the start, where a step costs its
/// length over the squared distance to the wall, keep to the middle (as VMTK does: Antiga et al., Med Biol Eng Comput
/// 2008;46:1097). Without ends, the farthest voxel that no path has come near begins the next path (Sato et al.,
/// TEASAR, 2000). Then spheres are moved to where they are largest.
#include <optional>
#include <string>
#include <vector>

#include "vascular/geometry/centreline/sphere_tree.h"
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

struct CentrelineOptions {
  std::optional<Eigen::Vector3d> start;  ///< none: the widest end
  std::vector<Eigen::Vector3d> ends;     ///< empty: all that stand out; picked points need not lie inside
  std::size_t most_voxels = 24'000'000;  ///< of the box around the mesh: sets the resolution
};

struct CentrelineResult {
  SphereTree tree;     ///< branches "1", "2", ... in the order of their length
  double voxel_m = 0;  ///< vessels narrower than two of these may be missed
};

/// Throws MeshError if the mesh has no inside, or a picked point is in another piece than the start.
CentrelineResult find_centrelines(const Mesh& mesh, const CentrelineOptions& options = {});

}  // namespace ostium::vascular
