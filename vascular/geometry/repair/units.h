#pragma once
/// What a number in a mesh's file means, told from how long and how wide the vessels are.
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

struct UnitGuess {
  LengthUnit unit = LengthUnit::millimetre;
  double extent_m = 0;   ///< the longest side of the box around it, in that unit
  double calibre_m = 0;  ///< 90 % of the wall's area belongs to vessels narrower than this
  bool certain = false;  ///< no other unit makes vessels of it
  bool vessel = false;   ///< this one does
};

/// `raw`: the file's numbers, as if they were metres. Compared with a coronary tree (110 mm long, 4 mm wide), and with
/// aortas with and without what leaves them (150 to 650 mm, 8 to 30 mm).
UnitGuess guess_unit(const Mesh& raw);

std::string name_of(LengthUnit unit);
/// "mm", "cm", "m" or "in".
LengthUnit unit_named(const std::string& name);

}  // namespace ostium::vascular
