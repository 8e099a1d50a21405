#pragma once
#include <Eigen/Core>

namespace ostium::fluoro {

/// One number per pixel; row 0 is the top of the picture, column 0 its left edge as viewed.
using Plane = Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace ostium::fluoro
