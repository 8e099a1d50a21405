#include "core/state.h"

#include <bit>
#include <stdexcept>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "core/math/rotation.h"

namespace ostium {

namespace {

/// Lays a rod out from its base, each joint turned by `strain(i)` times its cell's length.
template <class Strain>
RodState lay_out(const Rod& rod, const EndState& base, Strain&& strain) {
  const int N = rod.elements;
  RodState s;
  s.position.resize(N + 1);
  s.orientation.resize(N);
  s.turn.resize(N);
  s.turn_before.resize(N);
  s.force.resize(N);
  s.velocity.resize(N + 1);
  s.velocity_before.resize(N + 1);
  Eigen::Quaterniond q = Eigen::Quaterniond(base.q_W[0], base.q_W[1], base.q_W[2], base.q_W[3]).normalized();
  Eigen::Vector3d p = base.p_W;
  s.base.p_W = p, s.base.q_W = {q.w(), q.x(), q.y(), q.z()};
  for (int i = 0; i <= N; ++i) {
    s.position.set(i, p);
    if (i == N) break;
    const Eigen::Vector3d theta = rod.joint_length.at(0)[i] * strain(i);
    if (theta.norm() > 0) q = (q * Eigen::AngleAxisd(theta.norm(), theta.normalized())).normalized();
    s.orientation.set(i, {q.w(), q.x(), q.y(), q.z()});
    p += rod.length.at(0)[i] * (q * Eigen::Vector3d::UnitZ());
  }
  s.position_before = s.position;
  if (rod.damping.material_time_s > 0) {
    s.strain.resize(N + 1);
    for (int i = 0; i <= N; ++i) s.strain.set(i, strain(i));
    s.strain_before = s.strain;
  }
  s.tip.p_W = p;
  s.tip.q_W = {q.w(), q.x(), q.y(), q.z()};
  return s;
}

}  // namespace

State make_state(const Model& model, const std::vector<EndState>& bases) {
  State state;
  for (std::size_t r = 0; r < model.rods.size(); ++r)
    state.rods.push_back(
        lay_out(model.rods[r], bases.at(r), [](int) -> Eigen::Vector3d { return Eigen::Vector3d::Zero(); }));
  return state;
}

State make_state_at_rest_shape(const Model& model, const std::vector<EndState>& bases) {
  State state;
  for (std::size_t r = 0; r < model.rods.size(); ++r)
    state.rods.push_back(
        lay_out(model.rods[r], bases.at(r), [&](int i) -> Eigen::Vector3d { return model.rods[r].rest_curvature[i]; }));
  return state;
}

std::uint64_t hash(const State& state) {
  std::uint64_t h = state.step;
  for_each_field(state, [&](const char*, const double* first, int count) {
    h = XXH3_64bits_withSeed(first, count * sizeof(double), h);
  });
  return h;
}

std::vector<double> save(const State& state) {
  std::vector<double> out{std::bit_cast<double>(state.step)};
  for_each_field(state,
                 [&](const char*, const double* first, int count) { out.insert(out.end(), first, first + count); });
  return out;
}

void restore(const std::vector<double>& saved, State& state) {
  std::size_t wanted = 1;
  for_each_field(state, [&](const char*, double*, int count) { wanted += count; });
  if (saved.size() != wanted)
    throw std::invalid_argument("saved state: it has " + std::to_string(saved.size()) + " numbers, this model needs " +
                                std::to_string(wanted));
  const double* from = saved.data();
  state.step = std::bit_cast<std::uint64_t>(*from++);
  for_each_field(state, [&](const char*, double* first, int count) {
    from = (std::copy(from, from + count, first), from + count);
  });
}

std::string first_difference(const State& a, const State& b) {
  if (a.rods.size() != b.rods.size()) return "number of rods";
  if (a.step != b.step) return "step: " + std::to_string(a.step) + " != " + std::to_string(b.step);
  for (std::size_t r = 0; r < a.rods.size(); ++r) {
    State one_a{0, {a.rods[r]}}, one_b{0, {b.rods[r]}};
    std::vector<std::pair<const double*, int>> others;
    for_each_field(one_b, [&](const char*, const double* first, int count) { others.emplace_back(first, count); });
    std::size_t next = 0;
    std::string found;
    for_each_field(one_a, [&](const char* name, const double* first, int count) {
      const auto [other, other_count] = others[next++];
      if (!found.empty()) return;
      const std::string where = "rod " + std::to_string(r) + ", " + name;
      if (count != other_count) found = where + ": sizes differ";
      for (int i = 0; i < count && found.empty(); ++i)
        if (std::bit_cast<std::uint64_t>(first[i]) != std::bit_cast<std::uint64_t>(other[i]))
          found =
              where + "[" + std::to_string(i) + "]: " + std::to_string(first[i]) + " != " + std::to_string(other[i]);
    });
    if (!found.empty()) return found;
  }
  return {};
}

}  // namespace ostium
