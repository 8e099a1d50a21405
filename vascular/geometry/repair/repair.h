#pragma once
/// Anyone's mesh becomes closed lumens: what is turned is turned back, outer walls go, holes are closed, ends are
/// joined to ends and walls, overlapping pieces become one. Where the mesh was sound its calibre stays.
#include <functional>
#include <string>

#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

struct RepairOptions {
  double voxel_m = 0;                                ///< of the level set; 0: by the narrowest vessels
  double longest_gap_m = 8e-3;                       ///< no gap is bridged that is longer
  bool smooth_noise = true;                          ///< where the surface is rough
  std::size_t most_triangles = 200'000;              ///< of the result, about
  std::function<void(const std::string&)> progress;  ///< told what is being done; may be empty
};

/// One kind of mend: what was done, how often, where (at most 16 places).
struct RepairNote {
  std::string what;
  int count = 0;
  std::vector<Eigen::Vector3d> where;
};

struct RepairedMesh {
  Mesh lumen;  ///< closed, facing outwards; one component for each lumen, the largest first
  int lumens = 0;
  std::vector<RepairNote> notes;
  std::vector<Eigen::Vector3d> ends;  ///< middles of real openings that were closed: where vessels were cut off
  double voxel_m = 0;
};

/// Throws MeshError if nothing closed comes out of it.
RepairedMesh repair_mesh(Mesh mesh, const RepairOptions& options = {});

/// Connected parts, the one with the largest volume first.
std::vector<Mesh> components_of(const Mesh& mesh);

}  // namespace ostium::vascular
