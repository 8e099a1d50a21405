#pragma once
/// What a number in a mesh file may mean: the length units in which its vessels are as long and as wide as arteries
/// are.
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

/// Of the vessels in a mesh, in the mesh's unit. Lids hardly count: they are a small part of the wall.
struct VesselSize {
  double extent = 0;  ///< longest side of the bounding box
  double wide = 0;    ///< vessels narrower than this have 75 % of the wall's area
  double narrow = 0;  ///< likewise 10 %
};
VesselSize vessel_size(const Mesh& mesh);

struct UnitReading {
  LengthUnit unit = LengthUnit::millimetre;
  std::string vessel;  ///< what it is then, for messages: "a coronary artery"
};

/// All units in which a vessel of that size is an artery, a part of one, or a tree of them. One reading is certain; of
/// several only the user knows which one is right; with none, it is no artery.
std::vector<UnitReading> unit_readings(const VesselSize& size);

}  // namespace ostium::vascular
