#pragma once
#include "fluoro/base/plane.h"

namespace ostium::fluoro {

/// Means of blocks: `cells` along each side, which must divide the plane's side.
Plane block_means(const Plane& plane, int cells);
/// Linear interpolation between cell centres, constant beyond the outermost.
void enlarge(const Plane& coarse, Eigen::Index size, Plane& out);
/// Convolution with a Gaussian of that standard deviation, pixels; `beyond` gives the values outside the edges.
enum class Beyond { zero, same };
void gaussian_blur(Plane& plane, double sigma_pixels, Beyond beyond, Plane& scratch);

}  // namespace ostium::fluoro
