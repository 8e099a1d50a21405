#pragma once
/// Working memory of the binding, per rod.
#include <vector>

#include "core/binding/nesting.h"
#include "core/math/field.h"
#include "core/solve/chain.h"

namespace ostium {

/// Most elements of an inner rod that are solved with its outer rod, beyond the tip.
inline constexpr int max_beyond = 64;

/// Where an inner rod leaves an outer one: between two of its nodes.
struct Rim {
  int nesting = -1;
  int node = 0;       ///< the one before
  double along = 0;   ///< 0 at `node`, 1 at the next
  V3<double> normal;  ///< from the outer's tip outwards
  V3<double> centre;  ///< m, of the outer's tip, less the bulge of the rod's centreline over its polygon there
  V3<double> tangent;
  double room = 0;     ///< m, clearance: normal . (point of the polygon - centre) is to be at most this
  V3<double> tip;      ///< m, of the outer rod
  V3<double> edge;     ///< m, from `node` to the next
  double stay = 0;     ///< N/m of the tie across normal and tangent: the force turns with the point, like a pendulum
  double wall = 0;     ///< m/N, compliance of the bore's wall
  double force_N = 0;  ///< along `normal` on the outer rod; the part that the iterate's targets contain
};

struct BindingScratch {
  // --- as an outer rod
  bool carries = false;       ///< a rod that is in the body, too
  Rod whole;                  ///< it and what protrudes from its tip: its lengths and numbers alone
  int beyond = -1;            ///< the rod that protrudes
  int beyond_node = 0;        ///< its first node beyond the tip, which is node N + 1 of `whole`
  Field<3> beyond_position;   ///< m, (#nodes beyond the tip), strung from the tip as they were before the step
  Field<1> depth, cell;       ///< m, (#nodes of `whole`): from the introducer; half an element to each side
  Field<4> orientation;       ///< (#elements of `whole`), before the step
  Field<6> own_compliance;    ///< (#nodes), and
  Field<3> own_target;        ///< without inner rods
  Field<1> bending, damping;  ///< N m/rad, (#joints): lent, of elasticity and of material damping
  Field<1> spinning;          ///< N m/rad, (#joints): makes what protrudes spin with the tip
  Field<3> inner_turn;        ///< rad, (#elements), of the inner rods in the last step
  Field<3> gone_on;           ///< N m, (#joints): the moment of material damping if they went on turning so
  Field<3> moment;            ///< N m, (#joints), and
  Field<3> force;             ///< N, (#elements), of the inner rods in the last step
  Field<3> torque;            ///< N m, (#elements): takes their balance in the last step out of the equations
  Field<1> spring;            ///< N/m, (#nodes): their inertia, and
  Field<3> pull;              ///< N, (#nodes): times how they would move of themselves
  Field<3> given;             ///< N, (#nodes): what they exert in the iterates
  Field<3> owed,
      owed_before;  ///< N, (#nodes): that, less what the iterate was moved by; of this turn and the one before
  Field<3> more, correction;  ///< N, (#nodes): what was added to the forces for it, last and in all
  Field<3> own_force;         ///< N, (#elements): without the inner rods'
  int corrections = 0;        ///< so far in this step

  // --- as an inner rod
  Field<3> moves;            ///< m, (#nodes): see moves_of_inner
  std::vector<int> nesting;  ///< (#nodes), -1 where it is in no lumen
  std::vector<int> element;  ///< of the outer rod, (#nodes)
  Field<1> along;            ///< on that element, 0 to 1
  Field<3> centre;           ///< m, of the lumen beside the node
  Field<3> tangent, normal;
  Field<1> room;             ///< m, clearance
  Field<1> wall;             ///< m/N, compliance of the bore's wall
  Field<1> softness;         ///< m/N of the tie along `normal`; infinite: not tied
  Field<1> stay;             ///< N/m of the tie across it
  bool slides = false;       ///< with friction
  Field<1> slide_stiffness;  ///< N/m of friction, (#nodes)
  Field<2> slide_place;      ///< m, along the tangent and around: where it pulls the node to, (#nodes)
  Field<1> turn_stiffness;   ///< N m/rad of friction, (#elements), and
  Field<1> turn_torque;      ///< N m, without a turn
  int last = 0;              ///< node that can be tied
  int changes = 0;           ///< of ties in this step
  Field<6> free_compliance;  ///< as they would be without ties
  Field<3> free_target;
  Field<3> force_on_outer;   ///< N, (#nodes), of the tie, and
  Field<3> on_outer;         ///< with the rims' share
  Rim rims[max_outer_rods];  ///< the first `rim_count` are in use
  int rim_count = 0;
  std::vector<ChainLoad> rim_loads;
};

}  // namespace ostium
