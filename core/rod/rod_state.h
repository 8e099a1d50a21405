#pragma once
/// What the integrator remembers of one rod.
#include <Eigen/Core>

#include "core/math/field.h"

namespace ostium {

/// One end of a rod, as it is or was held.
struct EndState {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  ///< m
  Eigen::Vector4d q_W = {1, 0, 0, 0};             ///< material frame, quaternion w x y z
  double hold = -1;                               ///< the Hold of the last step, as a number; -1: none yet

  Q4<double> frame() const { return {q_W[0], q_W[1], q_W[2], q_W[3]}; }
};

struct RodState {
  double inserted_m = 0;  ///< length from the introducer to the tip
  double slack_m = 0;     ///< what the base element is longer than inserted_m has it; fades, see introducer.h
  double first = 0;       ///< the first element that takes part, as a number; fields before it are stale
  double exposed =
      0;              ///< the first element that no other rod is around, as a number; N: none. The outermost's: `first`
  Field<3> position;  ///< m, (#nodes)
  Field<3> position_before;  ///< one step earlier
  Field<3> velocity;         ///< m/s, (#nodes)
  Field<3> velocity_before;
  Field<4> orientation;  ///< unit quaternion w x y z, material to world, (#elements)
  Field<3> turn;         ///< rad, world frame, (#elements): of the last step
  Field<3> turn_before;
  Field<3> force;   ///< N, world frame, (#elements): internal, distal on proximal; with that of the rods inside
  Field<3> strain;  ///< 1/m, material frame, (#joints), Darboux vector; empty without material damping
  Field<3> strain_before;
  Field<3> crept_fast, crept_slow;  ///< 1/m, (#joints), of the branches of relaxing.h; empty without relaxation
  Field<3> contact_force;           ///< N, (#nodes), on the rod around it, and
  Field<3> offset;  ///< m, (#nodes), from the middle of that rod's lumen; zero outside. Empty if it can be in none
  Field<2> slip;  ///< m, (#nodes): elastic part of its sliding along that lumen and around in it, see solve/friction.h
  Field<3> wall_force;  ///< N, (#nodes), normal force of the walls on it; empty if there are none
  Field<2> wall_slip;   ///< m, (#nodes): elastic part of its sliding along and around there
  Field<3> rod_force;   ///< N, (#nodes), of other rods beside it, and its own; empty unless they touch
  EndState base, tip;
};

inline int first_element(const RodState& rod) { return static_cast<int>(rod.first); }

}  // namespace ostium
