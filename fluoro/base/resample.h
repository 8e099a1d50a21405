#pragma once
#include "fluoro/base/plane.h"

namespace ostium::fluoro {

/// Means of blocks: `cells` along each side, which divides the plane's.
Plane block_means(const Plane& plane, int cells);
/// Between the middles of the cells linear, constant beyond the outermost.
void enlarge(const Plane& coarse, Eigen::Index size, Plane& out);
/// Convolution with a Gaussian of that standard deviation, pixels; beyond the edges as `beyond` says.
enum class Beyond { zero, same };
void gaussian_blur(Plane& plane, double sigma_pixels, Beyond beyond, Plane& scratch);

}  // namespace ostium::fluoro
