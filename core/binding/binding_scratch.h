#pragma once
/// Working memory of the binding, per rod.
#include <vector>

#include "core/binding/nesting.h"
#include "core/math/field.h"
#include "core/solve/chain.h"

namespace ostium {

/// Where an inner rod leaves an outer one: between two of its nodes.
struct Rim {
  int nesting = -1;
  int node = 0;        ///< the one before
  double along = 0;    ///< 0 at `node`, 1 at the next
  V3<double> normal;   ///< from the outer's tip outwards
  V3<double> centre;   ///< m, of the outer's tip, less the bulge of the rod's centreline over its polygon there
  V3<double> tangent;
  double room = 0;  ///< m, clearance: normal . (point of the polygon - centre) is to be at most this
  double wall = 0;     ///< m/N, compliance of the bore's wall
  double force_N = 0;  ///< along `normal` on the outer rod; the part that the iterate's targets contain
};

struct BindingScratch {
  // --- as an outer rod: what the inner ones lend it
  Field<1> bending;   ///< N m2/m, (#joints)
  Field<1> turning;   ///< N m/rad, (#elements): of tension
  double tip_turning = 0;  ///< N m/rad, of the last element: of what lies beyond the tip
  V3<double> tip_torque;   ///< N m: tip_turning times the turn of what lies beyond
  Field<1> spring;    ///< N/m, (#nodes): of the inner rods' inertia
  Field<3> pull;      ///< N, (#nodes): springs times the moves that the inner rods would make of themselves

  // --- as an inner rod
  Field<3> moves;            ///< m, (#nodes): see moves_of_inner
  std::vector<int> nesting;  ///< (#nodes), -1 where it is in no lumen
  std::vector<int> element;  ///< of the outer rod, (#nodes)
  Field<1> along;            ///< on that element, 0 to 1
  Field<3> centre;           ///< m, of the lumen beside the node
  Field<3> tangent, normal;
  Field<1> room;      ///< m, clearance
  Field<1> wall;      ///< m/N, compliance of the bore's wall
  Field<1> softness;  ///< m/N of the tie along `normal`; infinite: not tied
  Field<1> stay;      ///< N/m of the tie across it
  int last = 0;      ///< node that can be tied
  int changes = 0;   ///< of ties in this step
  Field<6> free_compliance;  ///< as they would be without ties
  Field<3> free_target;
  Rim rims[max_outer_rods];  ///< the first `rim_count` are in use
  int rim_count = 0;
  std::vector<ChainLoad> rim_loads;
};

}  // namespace ostium
