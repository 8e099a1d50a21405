#pragma once
/// What OpenVDB does of the level set, in a library of its own that is loaded when a mesh is mended: OpenVDB has 70,000
/// symbols that are looked up wherever it is loaded, which took half of the time in which any command starts.
#include <Eigen/Core>
#include <array>
#include <functional>
#include <vector>

namespace ostium::vascular {

/// In voxels. Faces are turned as OpenVDB turns them: outwards.
struct ContouredSurface {
  std::vector<Eigen::Vector3f> points;
  std::vector<std::array<unsigned, 3>> triangles;
  std::vector<std::array<unsigned, 4>> quads;
};

/// Whether the middle of a voxel lies inside. Asked by several threads.
using Inside = std::function<bool(const Eigen::Vector3i&)>;

/// The surface at which what is inside ends: distances to `wall` (corners in voxels) near it, then contouring.
using Contour = ContouredSurface(const std::vector<Eigen::Vector3f>& corners,
                                 const std::vector<std::array<int, 3>>& wall, const Inside& is_inside);

inline constexpr const char* openvdb_module = "libostium-openvdb.so";
inline constexpr const char* contour_function = "ostium_contour";

extern "C" Contour ostium_contour;

}  // namespace ostium::vascular
