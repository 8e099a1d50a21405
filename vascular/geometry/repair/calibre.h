#pragma once
/// How wide a vessel is at each triangle of its wall: the way straight inwards to the wall opposite ("shape diameter").
#include "vascular/geometry/mesh/bounding_volume_hierarchy.h"

namespace ostium::vascular {

/// Diameters, m, of triangles 0, stride, 2 stride, ...; 0 where nothing is opposite within `farthest_m`. Triangles face
/// outwards.
std::vector<double> calibres(const Mesh& mesh, const BoundingVolumeHierarchy& tree, int stride = 1,
                             double farthest_m = 80e-3);

/// Of those that are not 0: the smallest with so great a share of them below it, or of their weights.
double percentile(std::vector<double> values, double share);
double percentile(const std::vector<double>& values, const std::vector<double>& weights, double share);

/// Of triangles 0, stride, 2 stride, ..., m2.
std::vector<double> areas_m2(const Mesh& mesh, int stride = 1);

}  // namespace ostium::vascular
