#pragma once
#include "vascular/geometry/repair/units.h"

namespace ostium::app {

/// Replaces the guessed unit, and converts the mesh's measurements to it.
inline void take_unit(vascular::LengthUnit unit, vascular::UnitGuess& guess) {
  const double ratio = metres(unit) / metres(guess.unit);
  guess.unit = unit, guess.extent_m *= ratio, guess.calibre_m *= ratio;
}

}  // namespace ostium::app
