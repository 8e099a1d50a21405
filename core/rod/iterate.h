#pragma once
/// The Newton iterate of one rod.
#include "core/model/rod.h"
#include "core/model/scratch.h"

namespace ostium::core {

struct IterateChange {
  bool finite = true;   ///< false: the solution was not a number, and the iterate is as it was
  double turn_rad = 0;  ///< largest turn of an element, or roll
  double fraction = 1;  ///< of the solution that was taken
  double stretch = 0;   ///< largest |(r_j+1 - r_j) / l_j - d3_j|
  double defect = 0;    ///< the same without the give of tolerances.h: what the linearised constraint left
};

/// Nodes along the tangents of `orientation`, from `end` at the base or at the tip: inextensible to the last bit.
void string_nodes(const Rod& rod, const Field<4>& orientation, V3<double> end, bool from_base, Field<3>& position);

/// Largest turn of an element in the chain's solution; not a number if the solution is none.
double largest_turn(const Rod& rod, const BlockTridiagonal& chain);

/// Takes the chain's solution as the next iterate, shortened so that no element turns by more than `max_turn_rad`:
/// writes scratch.orientation, turn, force and position.
IterateChange update_iterate(const Rod& rod, double max_turn_rad, RodScratch& scratch);

}  // namespace ostium::core
