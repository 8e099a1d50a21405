#pragma once
/// Surface noise: measurement and removal.
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

/// Deviation of vertices from a smooth surface, and edge length: medians.
struct Roughness {
  double height_m = 0, edge_m = 0;
  /// Rougher than triangles with such edges would be on a smooth vessel of that radius.
  bool noisy(double radius_m) const { return height_m > 30e-6 + 0.2 * edge_m * edge_m / radius_m; }
};
Roughness roughness(const Mesh& mesh);

/// Moves vertices towards the mean of their neighbours and back by slightly more, which preserves volume and calibre
/// (Taubin, SIGGRAPH 1995). Vertices of open edges are fixed.
void smooth(Mesh& mesh, int rounds);

}  // namespace ostium::vascular
