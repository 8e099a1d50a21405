#pragma once
/// Names of length units, as the command line and files have them.
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

inline constexpr LengthUnit length_units[] = {LengthUnit::millimetre, LengthUnit::centimetre, LengthUnit::metre,
                                              LengthUnit::inch};

std::string name_of(LengthUnit unit);
/// "mm", "cm", "m" or "in". Throws MeshError for another name.
LengthUnit unit_named(const std::string& name);

}  // namespace ostium::vascular
