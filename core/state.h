#pragma once
/// All that is needed to go on bit-identically: what the integrator remembers, warm starts included. Its fields are
/// listed once, in `for_each_field`; hash, save, compare and print use that list.
#include <cstdint>
#include <string>
#include <vector>

#include "core/model.h"

namespace ostium {

/// One end of a rod, as it is or was held.
struct EndState {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  ///< m
  Eigen::Vector4d q_W = {1, 0, 0, 0};             ///< material frame, quaternion w x y z
  double hold = -1;                               ///< the Hold of the last step, as a number; -1: none yet

  Q4<double> frame() const { return {q_W[0], q_W[1], q_W[2], q_W[3]}; }
};

struct RodState {
  double inserted_m = 0;     ///< length from the introducer to the tip
  double slack_m = 0;        ///< what the base element is longer than inserted_m has it; fades, see introducer.h
  double first = 0;          ///< the first element that takes part, as a number; fields before it are stale
  Field<3> position;         ///< m, (#nodes)
  Field<3> position_before;  ///< one step earlier
  Field<3> velocity;         ///< m/s, (#nodes)
  Field<3> velocity_before;
  Field<4> orientation;  ///< unit quaternion w x y z, material to world, (#elements)
  Field<3> turn;         ///< rad, world frame, (#elements): of the last step
  Field<3> turn_before;
  Field<3> force;   ///< N, world frame, (#elements): internal, distal on proximal
  Field<3> strain;  ///< 1/m, material frame, (#joints), Darboux vector; empty without material damping
  Field<3> strain_before;
  Field<3> moment;         ///< N m, world frame, (#joints), distal on proximal, and
  Field<3> acceleration;   ///< m/s2, (#nodes); both empty if it is in no nesting
  Field<3> inner_force;    ///< N, (#nodes), of the rods inside it; empty if none can be
  Field<3> contact_force;  ///< N, (#nodes), on the rod around it, and
  Field<3> offset;  ///< m, (#nodes), from the middle of that rod's lumen; zero outside. Empty if it can be in none
  Field<3> offset_before;
  Field<2> slip;  ///< m, (#nodes): elastic part of its sliding along that lumen and around in it, see solve/friction.h
  Field<2> inner_drag;  ///< N along and N m about d3, (#elements), of friction of the rods inside it; smoothed
  Field<3> wall_force;  ///< N, (#nodes), normal force of the walls on it; empty if there are none
  Field<2> wall_slip;   ///< m, (#nodes): elastic part of its sliding along and around there
  EndState base, tip;
};

inline int first_element(const RodState& rod) { return static_cast<int>(rod.first); }

struct NestingState {
  Eigen::Vector3d rim_force_W_N = Eigen::Vector3d::Zero();  ///< of the inner rod on the outer one's tip
};

struct State {
  std::uint64_t step = 0;
  std::vector<RodState> rods;
  std::vector<NestingState> nestings;
};

/// Rods straight from their base poses along d3 and at rest; `bases[i]` belongs to rod i, and so does `inserted_m[i]`,
/// the length beyond the base (whole rods if empty; below least_inserted_m of introducer.h: not in the body).
State make_state(const Model& model, const std::vector<EndState>& bases, const std::vector<double>& inserted_m = {});
/// The same with every rod in its unloaded shape.
State make_state_at_rest_shape(const Model& model, const std::vector<EndState>& bases,
                               const std::vector<double>& inserted_m = {});

/// Calls visit(name, first, count) with `count` doubles for each field of each rod, in a fixed order. `S` is State or
/// const State. The step number is not among them.
template <class S, class Visit>
void for_each_field(S& state, Visit&& visit) {
  for (auto& rod : state.rods) {
    visit("inserted_m", &rod.inserted_m, 1);
    visit("slack_m", &rod.slack_m, 1);
    visit("first", &rod.first, 1);
    const auto components = [&](const char* name, auto& field) {
      for (int c = 0; c < static_cast<int>(field.raw().size()) / std::max(field.stride(), 1); ++c)
        visit(name, field.at(c), field.size());
    };
    components("position", rod.position);
    components("position_before", rod.position_before);
    components("velocity", rod.velocity);
    components("velocity_before", rod.velocity_before);
    components("orientation", rod.orientation);
    components("turn", rod.turn);
    components("turn_before", rod.turn_before);
    components("force", rod.force);
    components("strain", rod.strain);
    components("strain_before", rod.strain_before);
    components("moment", rod.moment);
    components("acceleration", rod.acceleration);
    components("inner_force", rod.inner_force);
    components("contact_force", rod.contact_force);
    components("offset", rod.offset);
    components("offset_before", rod.offset_before);
    components("slip", rod.slip);
    components("inner_drag", rod.inner_drag);
    components("wall_force", rod.wall_force);
    components("wall_slip", rod.wall_slip);
    for (auto* end : {&rod.base, &rod.tip}) {
      visit("end.p_W", end->p_W.data(), 3);
      visit("end.q_W", end->q_W.data(), 4);
      visit("end.hold", &end->hold, 1);
    }
  }
  for (auto& nesting : state.nestings) visit("rim_force_W_N", nesting.rim_force_W_N.data(), 3);
}

/// 64-bit hash of the step number and every field (XXH3 over their bytes: -0 and 0 differ).
std::uint64_t hash(const State& state);

/// Numbers of a state in the order of the list, the step number first; and back. `restore` wants a state of the same
/// model (made by make_state) and throws std::invalid_argument if the count differs, leaving the state untouched.
std::vector<double> save(const State& state);
void restore(const std::vector<double>& saved, State& state);

/// "rod 0, velocity[12]: 0.1 != 0.2" for the first difference, or empty if the states are bit-identical.
std::string first_difference(const State& a, const State& b);

}  // namespace ostium
