#pragma once
/// All that is needed to go on bit-identically: what the integrator remembers, warm starts included. Its fields are
/// listed once, in `for_each_field`; hash, save, compare and print use that list.
#include <cstdint>
#include <string>
#include <vector>

#include "core/model.h"
#include "core/rod/rod_state.h"

namespace ostium {

struct State {
  std::uint64_t step = 0;
  std::vector<RodState> rods;
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
    visit("exposed", &rod.exposed, 1);
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
    components("crept_fast", rod.crept_fast);
    components("crept_slow", rod.crept_slow);
    components("contact_force", rod.contact_force);
    components("offset", rod.offset);
    components("slip", rod.slip);
    components("wall_force", rod.wall_force);
    components("wall_slip", rod.wall_slip);
    components("rod_force", rod.rod_force);
    for (auto* end : {&rod.base, &rod.tip}) {
      visit("end.p_W", end->p_W.data(), 3);
      visit("end.q_W", end->q_W.data(), 4);
      visit("end.hold", &end->hold, 1);
    }
  }
}

/// 64-bit hash (XXH3 of bytes: -0 and 0 differ) of the step number and all that the next steps may come of.
std::uint64_t hash(const State& state);

/// Numbers of a state in the order of the list, the step number first; and back. `restore` wants a state of the same
/// model (made by make_state) and throws std::invalid_argument if the count differs, leaving the state untouched.
std::vector<double> save(const State& state);
void restore(const std::vector<double>& saved, State& state);

/// "rod 0, velocity[12]: 0.1 != 0.2" for the first difference, or empty if the states are bit-identical.
std::string first_difference(const State& a, const State& b);

}  // namespace ostium
