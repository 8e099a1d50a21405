#pragma once
/// The centreline-sphere tree of any closed mesh: fully automatic, or with a start, ends and intermediate points chosen
/// by a user.
///
/// Voxels inside the mesh store their distance to the wall. Cheapest paths from the start, with a cost of length over
/// squared wall distance, stay in the middle (as in VMTK: Antiga et al., Med Biol Eng Comput 2008;46:1097). Without
/// given ends, the farthest voxel not yet covered by a path starts the next one (Sato et al., TEASAR, 2000). Finally,
/// spheres are moved to where they are largest, and lines carried on to the lids of the lumen (line_fit.h).
#include <optional>
#include <string>
#include <vector>

#include "vascular/geometry/centreline/sphere_tree.h"
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

struct CentrelineOptions {
  std::optional<Eigen::Vector3d> start;  ///< none: the widest end
  std::vector<Eigen::Vector3d> ends;     ///< empty: all that are found; picked points need not lie inside
  bool to_lids = true;  ///< lines end at the lids of the lumen; false: with the last whole sphere inside it
  std::size_t most_voxels = 24'000'000;  ///< of the box around the mesh: sets the resolution
};

struct CentrelineResult {
  SphereTree tree;                    ///< branches "1", "2", ... longest first
  double voxel_m = 0;                 ///< vessels narrower than two of these may be missed
  std::vector<Eigen::Vector3d> cuts;  ///< where loops of the lumen were cut open: a tree has none
};

/// Throws MeshError if the mesh has no interior, or a picked point is in a different piece than the start.
CentrelineResult find_centrelines(const Mesh& mesh, const CentrelineOptions& options = {});

}  // namespace ostium::vascular
