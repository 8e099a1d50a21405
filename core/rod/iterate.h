#pragma once
/// The Newton iterate of one rod.
#include "core/model/rod.h"
#include "core/model/scratch.h"

namespace ostium::core {

struct IterateChange {
  bool finite = true;   ///< false: the solution was not finite, and the iterate is unchanged
  double turn_rad = 0;  ///< largest turn of an element or roll
  double fraction = 1;  ///< of the solution that was applied
  double stretch = 0;   ///< largest |(r_j+1 - r_j) / l_j - d3_j|
  double defect = 0;    ///< the same without the axial compliance of tolerances.h: error of the linearised constraint
};

/// Places nodes along the tangents of `orientation`, from `end` at the base or at the tip: exactly inextensible.
void string_nodes(const Rod& rod, const Field<4>& orientation, V3<double> end, bool from_base, Field<3>& position);

/// Largest turn of an element in the chain's solution; not-a-number if the solution is not finite.
double largest_turn(const Rod& rod, const BlockTridiagonal& chain);

/// Applies the chain's solution to the iterate, scaled so that no element turns by more than `max_turn_rad`: writes
/// scratch.orientation, turn, force and position.
IterateChange update_iterate(const Rod& rod, double max_turn_rad, RodScratch& scratch);

// --- the same in parts, for chains that fork
/// How much of a solution may be applied: turn_rad, finite and fraction.
IterateChange measure_solution(const Rod& rod, double max_turn_rad, const BlockTridiagonal& chain);
/// Applies that share of it to frames and forces.
void apply_solution(const Rod& rod, double fraction, RodScratch& scratch);
/// Places the nodes by the forces; `pull`: N, of branches on the last one. The first goes where it is held.
void place_nodes(const Rod& rod, const V3<double>& pull, RodScratch& scratch);
/// Sets stretch and defect.
void measure_defect(const Rod& rod, const RodScratch& scratch, IterateChange& change);

}  // namespace ostium::core
