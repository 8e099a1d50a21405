#pragma once
/// What the reader of one format hands to `read_mesh`, which scales, welds and counts.
#include <Eigen/Core>
#include <string>
#include <vector>

namespace ostium::vascular {

struct RawSurface {
  std::vector<Eigen::Vector3d> corners;  ///< three per triangle, in the file's unit
  int skipped = 0;                       ///< points and lines
};

/// Whatever assimp reads. Throws MeshError.
RawSurface read_assimp(const std::string& path);
/// VTK's files, XML or legacy: their first bytes decide, not their ending. Throws MeshError.
RawSurface read_vtk(const std::string& path);

}  // namespace ostium::vascular
