#pragma once
/// Turns any mesh into closed lumens: flipped triangles are turned, outer walls removed, holes closed, ends joined to
/// ends and walls, overlapping pieces merged. Where the mesh was sound, its calibre is kept.
#include <functional>
#include <string>

#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

struct RepairOptions {
  double voxel_m = 0;                                     ///< of the level set; 0: from the narrowest of the vessels
  double narrowest_m = 0;                                 ///< diameter of a throat that is known; 0: of none
  double longest_gap_m = 8e-3;                            ///< longer gaps are not bridged
  bool smooth_noise = true;                               ///< where the surface is rough
  std::size_t most_triangles = 200'000;                   ///< of the result, about
  std::function<void(const std::string&)> progress = {};  ///< reports each stage; may be empty
};

/// One kind of repair: what, how often, and where (at most 16 positions).
struct RepairNote {
  std::string what;
  int count = 0;
  std::vector<Eigen::Vector3d> where;
};

struct RepairedMesh {
  Mesh lumen;  ///< closed, facing outwards; one component per lumen, largest first
  int lumens = 0;
  std::vector<RepairNote> notes;
  std::vector<Eigen::Vector3d> ends;  ///< centres of real openings that were closed: where vessels were cut off
  double voxel_m = 0;
  double finest_m = 0;  ///< the one that was asked for, or the finest that is chosen for this mesh
};

inline constexpr double voxels_across = 3.5;  ///< the narrowest vessels, where `voxel_m` is chosen

constexpr double crumb_m3 = 8e-9;  ///< smaller lumens are dropped
inline constexpr const char* too_small =
    "what is closed in the mesh is smaller than 8 mm3, too small for instruments; is its unit right? say it with "
    "--units";

/// Throws MeshError if no closed lumen results.
RepairedMesh repair_mesh(Mesh mesh, const RepairOptions& options = {});

/// Connected components, largest volume first.
std::vector<Mesh> components_of(const Mesh& mesh);

}  // namespace ostium::vascular
