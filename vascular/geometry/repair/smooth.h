#pragma once
/// Noise of a surface: how rough it is, and its removal.
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

/// How far vertices stand out from a smooth surface, and how long edges are: medians.
struct Roughness {
  double height_m = 0, edge_m = 0;
  /// Rougher than triangles with such edges make a vessel of so small a radius.
  bool noisy(double radius_m) const { return height_m > 30e-6 + 0.2 * edge_m * edge_m / radius_m; }
};
Roughness roughness(const Mesh& mesh);

/// Moves vertices towards the mean of their neighbours and back by a little more, which keeps volume and calibre
/// (Taubin, SIGGRAPH 1995). Vertices of open edges stay.
void smooth(Mesh& mesh, int rounds);

}  // namespace ostium::vascular
