#pragma once
#include "vascular/geometry/repair/units.h"

namespace ostium::app {

/// Another unit than the guessed one: what the mesh measures in it.
inline void take_unit(vascular::LengthUnit unit, vascular::UnitGuess& guess) {
  const double ratio = metres(unit) / metres(guess.unit);
  guess.unit = unit, guess.extent_m *= ratio, guess.calibre_m *= ratio;
}

}  // namespace ostium::app
