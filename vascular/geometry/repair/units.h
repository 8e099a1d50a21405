#pragma once
/// Guesses the length unit of a mesh file from the length and width of the vessels.
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

struct UnitGuess {
  LengthUnit unit = LengthUnit::millimetre;
  double extent_m = 0;   ///< longest side of the bounding box, in that unit
  double calibre_m = 0;  ///< vessels narrower than this have 90 % of the wall's area
  bool certain = false;  ///< no other unit gives plausible vessels
  bool vessel = false;   ///< this unit does
};

/// `raw`: the file's numbers taken as metres. Compared with a coronary tree (110 mm long, 4 mm wide), and with aortas
/// with and without branches (150 to 650 mm, 8 to 30 mm).
UnitGuess guess_unit(const Mesh& raw);

std::string name_of(LengthUnit unit);
/// "mm", "cm", "m" or "in".
LengthUnit unit_named(const std::string& name);

}  // namespace ostium::vascular
