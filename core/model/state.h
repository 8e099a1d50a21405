#pragma once
/// Everything needed to continue bit-identically: the integrator's state, including warm starts. Its fields are listed
/// once, here and in rod_state.h; hash, save, compare and print use these lists (base/fields.h).
#include <cstdint>
#include <string>
#include <vector>

#include "core/model/model.h"
#include "core/model/rod_state.h"

namespace ostium::core {

struct State {
  std::uint64_t step = 0;
  std::vector<RodState> rods;
};
constexpr auto fields(const State*) { return std::tuple{field("step", &State::step), field("rods", &State::rods)}; }

/// 64-bit hash (XXH3 of bytes: -0 and 0 differ) of the step number and everything that affects later steps.
std::uint64_t hash(const State& state);

/// The numbers of a state in the order of the lists, step number first; and back. `restore` needs a state of the same
/// model (from make_state) and throws std::invalid_argument if the count differs, leaving the state unchanged.
std::vector<double> save(const State& state);
void restore(const std::vector<double>& saved, State& state);

/// "rod 0, velocity[12]: 0.1 != 0.2" for the first difference, or empty if the states are bit-identical.
std::string first_difference(const State& a, const State& b);

}  // namespace ostium::core
