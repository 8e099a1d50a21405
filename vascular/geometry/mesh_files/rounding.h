#pragma once
/// How finely a file tells where the corners of its mesh are.
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

/// Rounding by more than this share of the vessels' width is told.
inline constexpr double rounding_matters = 0.005;

/// Distance between two neighbouring numbers of the file, in its unit: of single precision at the farthest coordinate
/// if all fit into that, or a power of ten at and below 1 if all are multiples of it. `raw`: the numbers as they stand
/// there. Too few corners to tell decimals from round numbers have none.
double rounding_step(const Mesh& raw);

}  // namespace ostium::vascular
