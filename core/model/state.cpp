#include "core/model/state.h"

#include <algorithm>
#include <span>
#include <stdexcept>

namespace ostium::core {

namespace {

/// Entries outside the introducer are reset when fed in, so they are not hashed; except what the material remembers.
template <int K>
std::uint64_t hash_inside(const Field<K>& field, int first, std::uint64_t h) {
  for (int c = 0; c < K; ++c)
    h = hash_numbers(
        std::span(field.at(c), static_cast<std::size_t>(field.size())).subspan(std::min(first, field.size())), h);
  return h;
}

std::uint64_t hash(const RodState& rod, std::uint64_t h) {
  for_each_field(rod, [&](const char*, const auto& member) {
    const void* at = &member;
    if constexpr (requires { member.components; })
      h = at == &rod.crept_fast || at == &rod.crept_slow ? hash_fields(member, h) : hash_inside(member, rod.first, h);
    else
      h = hash_fields(member, h);
  });
  return h;
}

}  // namespace

std::uint64_t hash(const State& state) {
  std::uint64_t h = state.step;
  for (const RodState& rod : state.rods) h = hash(rod, h);
  return h;
}

std::vector<double> save(const State& state) {
  std::vector<double> out(count_fields(state));
  put_fields(state, out.data());
  return out;
}

void restore(const std::vector<double>& saved, State& state) {
  if (const std::size_t wanted = count_fields(state); saved.size() != wanted)
    throw std::invalid_argument("saved state: it has " + std::to_string(saved.size()) + " numbers, this model needs " +
                                std::to_string(wanted));
  take_fields(saved.data(), state);
}

std::string first_difference(const State& a, const State& b) {
  if (a.rods.size() != b.rods.size()) return "number of rods";
  if (a.step != b.step) return first_different_field(a, b);
  for (std::size_t r = 0; r < a.rods.size(); ++r)
    if (const std::string found = first_different_field(a.rods[r], b.rods[r]); !found.empty())
      return "rod " + std::to_string(r) + ", " + found;
  return "";
}

}  // namespace ostium::core
