#pragma once
/// Width of a vessel at each triangle of its wall: straight inwards to the opposite wall ("shape diameter").
#include "vascular/geometry/mesh/bounding_volume_hierarchy.h"

namespace ostium::vascular {

/// Diameters, m, of triangles 0, stride, 2 stride, ...; 0 if there is no wall within `farthest_m`. Triangles face
/// outwards.
std::vector<double> calibres(const Mesh& mesh, const BoundingVolumeHierarchy& tree, int stride = 1,
                             double farthest_m = 80e-3);

/// Percentile of the non-zero values, optionally weighted.
double percentile(std::vector<double> values, double share);
double percentile(const std::vector<double>& values, const std::vector<double>& weights, double share);

/// Areas of triangles 0, stride, 2 stride, ..., m2.
std::vector<double> areas_m2(const Mesh& mesh, int stride = 1);

}  // namespace ostium::vascular
