#pragma once
/// Whether a lumen was squeezed or stretched along one axis on its way, as where the spacing of slices was left out.
#include <optional>

#include "vascular/geometry/implicit/tube.h"
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

struct AxisScale {
  int axis = 0;      ///< of the mesh
  double share = 1;  ///< width of cross-sections along it over that along the others: about the factor, if nearer to 1
};

/// Empty where cross-sections are as wide along each axis, to 15 %: those of healthy vessels are to 2 %. The tubes run
/// through the mesh.
std::optional<AxisScale> find_axis_scale(const Mesh& lumen, const std::vector<Tube>& tubes);

}  // namespace ostium::vascular
