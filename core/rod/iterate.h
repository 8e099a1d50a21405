#pragma once
/// The Newton iterate of one rod.
#include "core/rod/rod.h"
#include "core/scratch.h"

namespace ostium {

struct IterateChange {
  bool finite = true;     ///< false: the solution was not a number, and the iterate is as it was
  double turn_rad = 0;    ///< largest turn of an element
  double stretch = 0;     ///< largest |(r_j+1 - r_j) / l_j - d3_j|: what the linearised constraint left
};

/// Largest turn of an element in the chain's solution; not a number if the solution is none.
double largest_turn(const Rod& rod, const Chain& chain);

/// Takes the chain's solution as the next iterate, shortened so that no element turns by more than `max_turn_rad`:
/// writes scratch.orientation, turn, force and position.
IterateChange update_iterate(const Rod& rod, double max_turn_rad, RodScratch& scratch);

}  // namespace ostium
