#pragma once
/// Integrator state of one rod.
#include <Eigen/Core>
#include <optional>

#include "core/base/fields.h"
#include "core/math/field.h"
#include "core/model/hold.h"

namespace ostium::core {

/// One end of a rod and how it is or was held.
struct EndState {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  ///< m
  Eigen::Vector4d q_W = {1, 0, 0, 0};             ///< material frame, quaternion w x y z
  std::optional<Hold> hold;                       ///< in the last step; none before the first

  Q4<double> frame() const { return {q_W[0], q_W[1], q_W[2], q_W[3]}; }
};
constexpr auto fields(const EndState*) {
  return std::tuple{field("p_W", &EndState::p_W), field("q_W", &EndState::q_W), field("hold", &EndState::hold)};
}

struct RodState {
  double inserted_m = 0;     ///< length from the introducer to the tip
  double slack_m = 0;        ///< length of the base element beyond what inserted_m gives; fades, see introducer.h
  int first = 0;             ///< first active element; earlier entries are stale
  int exposed = 0;           ///< first element outside all other rods; N: none. For the outermost rod: `first`
  Field<3> position;         ///< m, (#nodes)
  Field<3> position_before;  ///< one step earlier
  Field<3> velocity;         ///< m/s, (#nodes)
  Field<3> velocity_before;
  Field<4> orientation;  ///< unit quaternion w x y z, material to world, (#elements)
  Field<3> turn;         ///< rad, world frame, (#elements): of the last step
  Field<3> turn_before;
  Field<3> force;   ///< N, world frame, (#elements): internal, distal on proximal; includes that of the rods inside
  Field<3> strain;  ///< 1/m, material frame, (#joints), Darboux vector; empty without material damping
  Field<3> strain_before;
  Field<3> crept_fast, crept_slow;  ///< 1/m, (#joints), of the branches of relaxing.h; empty without relaxation
  Field<3> contact_force;           ///< N, (#nodes), on the rod around it
  Field<3> offset;      ///< m, (#nodes), from the middle of that rod's lumen; zero outside. Empty if it can be in none
  Field<2> slip;        ///< m, (#nodes): elastic slip along and around that lumen, see solver/friction_spring.h
  Field<3> wall_force;  ///< N, (#nodes), normal force of the walls on it; empty if there are none
  Field<2> wall_slip;   ///< m, (#nodes): elastic slip along and around the instrument there
  Field<3> rod_force;   ///< N, (#nodes), from other rods and from itself; empty unless rods touch
  EndState base, tip;
};

constexpr auto fields(const RodState*) {
  using S = RodState;
  return std::tuple{field("inserted_m", &S::inserted_m),
                    field("slack_m", &S::slack_m),
                    field("first", &S::first),
                    field("exposed", &S::exposed),
                    field("position", &S::position),
                    field("position_before", &S::position_before),
                    field("velocity", &S::velocity),
                    field("velocity_before", &S::velocity_before),
                    field("orientation", &S::orientation),
                    field("turn", &S::turn),
                    field("turn_before", &S::turn_before),
                    field("force", &S::force),
                    field("strain", &S::strain),
                    field("strain_before", &S::strain_before),
                    field("crept_fast", &S::crept_fast),
                    field("crept_slow", &S::crept_slow),
                    field("contact_force", &S::contact_force),
                    field("offset", &S::offset),
                    field("slip", &S::slip),
                    field("wall_force", &S::wall_force),
                    field("wall_slip", &S::wall_slip),
                    field("rod_force", &S::rod_force),
                    field("base", &S::base),
                    field("tip", &S::tip)};
}

}  // namespace ostium::core
