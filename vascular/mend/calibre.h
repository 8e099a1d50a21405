#pragma once
/// How wide a vessel is at each triangle of its wall: the way straight inwards to the wall opposite ("shape diameter").
#include "vascular/box_tree.h"

namespace ostium {

/// Diameters, m, of triangles 0, stride, 2 stride, ...; 0 where nothing is opposite within `farthest_m`. Triangles face
/// outwards.
std::vector<double> calibres(const Mesh& mesh, const BoxTree& tree, int stride = 1, double farthest_m = 80e-3);

/// Of those that are not 0, weighted by nothing: the smallest with so great a share below it.
double percentile(std::vector<double> values, double share);

}  // namespace ostium
