#include "vascular/geometry/mesh/length_unit.h"

#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

double metres(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::millimetre:
      return 1e-3;
    case LengthUnit::centimetre:
      return 1e-2;
    case LengthUnit::inch:
      return 25.4e-3;
    case LengthUnit::metre:
      break;
  }
  return 1;
}

std::string name_of(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::millimetre:
      return "mm";
    case LengthUnit::centimetre:
      return "cm";
    case LengthUnit::inch:
      return "in";
    case LengthUnit::metre:
      break;
  }
  return "m";
}

LengthUnit unit_named(const std::string& name) {
  for (LengthUnit unit : length_units)
    if (name_of(unit) == name) return unit;
  throw MeshError("there is no unit \"" + name + "\"; expected mm, cm, m or in");
}

}  // namespace ostium::vascular
