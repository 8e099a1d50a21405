#include "core/step/statics.h"

#include <algorithm>
#include <cmath>

#include "core/base/tolerances.h"
#include "core/math/rotation.h"
#include "core/rod/elasticity.h"
#include "core/rod/ends.h"
#include "core/rod/inertia.h"
#include "core/rod/introducer.h"
#include "core/rod/iterate.h"
#include "core/step/step.h"

namespace ostium::core {

namespace {

/// A time long compared with the rod's slowest motion, so that inertia hardly matters.
double longest_time(const Rod& rod) {
  double compliance = 0;  // of bending, integrated: L / EI
  for (int i = rod.first; i < rod.nodes(); ++i)
    compliance += rod.joint_length.at(0)[i] / stiffness_at_rest(rod, i).head<2>().minCoeff();
  return tolerances::static_time_ratio *
         std::sqrt(rod.total_mass_kg * rod.total_length_m * rod.total_length_m * compliance);
}

/// Proximal term that keeps nodes near the last iterate p: r = p + (time^2 / m) (f + internal force).
void stay_near(const Rod& rod, const Eigen::Vector3d& gravity_W, const Eigen::Vector3d& tip_force_W, double time_s,
               RodScratch& s) {
  const double time2 = time_s * time_s;
  const V3<double> fall = from_eigen(time2 * gravity_W);
  for_packs(rod.first, rod.nodes(), [&]<class T>(T, int i) {
    store6(s.chain.compliance, i, (time2 / load<T>(rod.mass.at(0) + i)) * identity3<T>());
    store3(s.target, i, load3<T>(s.position, i) + V3<T>{splat<T>(fall.x), splat<T>(fall.y), splat<T>(fall.z)});
  });
  for (int i = rod.first; i < rod.dead_load.size(); ++i)
    s.target.set(i, s.target[i] + time2 / rod.mass.at(0)[i] * rod.dead_load[i]);
  const int N = rod.elements;
  s.target.set(N, s.target[N] + time2 / rod.mass.at(0)[N] * tip_force_W);
}

void start_at(const Rod& rod, const RodState& state, RodScratch& s) {
  s.geometric = GeometricStiffness::with;
  s.scheme = TimeScheme::bdf2;
  for_packs(rod.first, rod.nodes(), [&]<class T>(T, int i) { store3(s.position, i, load3<T>(state.position, i)); });
  for_packs(rod.first, rod.elements, [&]<class T>(T, int j) {
    store4(s.orientation, j, load4<T>(state.orientation, j));
    store3(s.turn, j, V3<T>{});
    store3(s.force, j, load3<T>(state.force, j));
  });
}

/// Solves one Newton step about the iterate.
void solve_step(const Rod& rod, const Eigen::Vector3d& gravity_W, const RodState& state, double time_s, RodScratch& s,
                TridiagonalFactors& factors) {
  stay_near(rod, gravity_W, s.inputs.tip_force_W_N, time_s, s);
  hold_ends(rod, s.inputs, state, s);
  linearise_joints(rod, state, joints_of(s.inputs), 0, s);
  assemble_elements(rod, s);
  add_rotary_inertia(rod, time_s, s);
  solve(s.chain, nullptr, factors);
}

/// End from which nodes are placed: the base, unless only the tip is fixed in position. A guided end may have slid.
struct Anchor {
  bool from_base;
  bool exists;

  explicit Anchor(const RodInputs& inputs) {
    const auto fixed = [](Hold h) { return h == Hold::clamped || h == Hold::pinned; };
    const bool base_held = inputs.base.hold != Hold::free;
    exists = base_held || inputs.tip.hold != Hold::free;
    from_base = base_held && (fixed(inputs.base.hold) || !fixed(inputs.tip.hold));
  }
  V3<double> of(const Rod& rod, const RodScratch& s) const {
    return load3<double>(s.position, from_base ? rod.first : rod.elements);
  }
};

/// Distance between the last placed node and the hold at the end opposite to the anchor.
double closure(const Rod& rod, const RodState& state, const RodInputs& inputs, const Anchor& anchor,
               const RodScratch& s) {
  const Hold hold = anchor.from_base ? inputs.tip.hold : inputs.base.hold;
  if (hold == Hold::free) return 0;
  const EndState& end = anchor.from_base ? state.tip : state.base;
  Eigen::Vector3d off = s.position[anchor.from_base ? rod.elements : rod.first] - end.p_W;
  if (hold == Hold::guided) off -= axis(end) * axis(end).dot(off);
  return off.norm();
}

/// Whether the new step takes back a good part of the last one, which then went too far. With a softening law
/// (superelastic.h) Newton's method would otherwise oscillate across the bend of the curve for ever.
bool turns_back(const Rod& rod, const RodScratch& s) {
  double along = 0, last = 0;
  for (int j = rod.first; j < rod.elements; ++j) {
    const V3<double> before = load3<double>(s.turn, j);
    along += dot(load3<double>(s.chain.turn, j), before), last += dot(before, before);
  }
  return along < -tolerances::static_turns_back * last;
}

RodEquilibrium settle(const Rod& rod, const Eigen::Vector3d& gravity_W, const RodState& state, RodScratch& s,
                      TridiagonalFactors& factors) {
  const Anchor anchor(s.inputs);
  RodEquilibrium out;
  if (!anchor.exists) return out;  // it would fall for ever

  const double longest = longest_time(rod);
  double time_s = longest / 100, growth = 8, part = 1;
  start_at(rod, state, s);
  while (out.iterations < tolerances::max_static_iterations && !out.converged) {
    ++out.iterations;
    solve_step(rod, gravity_W, state, time_s, s, factors);
    out.turn_rad = largest_turn(rod, s.chain);
    out.converged = time_s == longest && out.turn_rad < tolerances::static_tolerance_rad &&
                    closure(rod, state, s.inputs, anchor, s) < tolerances::static_closure * rod.total_length_m;

    // The step is too long for the linear model, or may lead uphill: retry with a shorter time, and increase it more
    // slowly afterwards.
    const bool trusted = out.turn_rad < tolerances::max_turn_rad && s.chain.definite;
    if (!out.converged && !trusted) {
      time_s /= 4;
      growth = 1.5;
      continue;
    }
    part = turns_back(rod, s) ? part / 2 : std::min(1.0, 2 * part);
    for_packs(rod.first, rod.elements, [&]<class T>(T, int j) { store3(s.turn, j, V3<T>{}); });  // of this step only
    if (!update_iterate(rod, std::min(tolerances::max_turn_rad, part * out.turn_rad), s).finite) return out;
    string_nodes(rod, s.orientation, anchor.of(rod, s), anchor.from_base, s.position);
    time_s = std::min(longest, time_s * (out.turn_rad < 0.1 ? growth : 1.5));
    growth = std::min(8.0, growth * 1.3);
  }
  out.negative_directions = negative_pivots(s.chain, factors);
  return out;
}

void take(const Rod& rod, RodScratch& s, RodState& state) {
  for_packs(rod.first, rod.nodes(), [&]<class T>(T, int i) { store3(state.position, i, load3<T>(s.position, i)); });
  for_packs(rod.first, rod.elements, [&]<class T>(T, int j) {
    store4(state.orientation, j, load4<T>(s.orientation, j));
    store3(state.force, j, load3<T>(s.force, j));
  });
  linearise_joints(rod, state, joints_of(s.inputs), 0, s);
  take_strain(rod, s, state);
  rest(rod, s.inputs, state);
}

}  // namespace

void find_equilibrium(const Model& model, const Inputs& inputs, State& state, Scratch& scratch,
                      std::vector<RodEquilibrium>& report) {
  report.resize(model.rods.size());
  for (std::size_t r = 0; r < model.rods.size(); ++r) {
    std::uint32_t trouble = 0;
    RodScratch& s = scratch.rods[r];
    s.inputs = limited(inputs.rods[r], trouble);
    cut_at_introducer(model.rods[r], state.rods[r], s.inside);
    if (!s.inside.in_body()) {
      report[r] = {};
      report[r].converged = true;
      continue;
    }
    report[r] = settle(s.inside, model.gravity_W, state.rods[r], s, scratch.factors);
    report[r].trouble = trouble;
    if (report[r].converged) take(s.inside, s, state.rods[r]);
  }
}

int negative_directions(const Model& model, const Inputs& inputs, const State& state, std::size_t r, Scratch& scratch) {
  std::uint32_t trouble = 0;
  RodScratch& s = scratch.rods[r];
  const Rod& rod = s.inside;
  s.inputs = limited(inputs.rods[r], trouble);
  cut_at_introducer(model.rods[r], state.rods[r], s.inside);
  if (!rod.in_body()) return 0;
  start_at(rod, state.rods[r], s);
  // The first solve finds the internal forces, the second includes their geometric stiffness.
  for (int pass = 0; pass < 2; ++pass) {
    solve_step(rod, model.gravity_W, state.rods[r], longest_time(rod), s, scratch.factors);
    for_packs(rod.first, rod.elements, [&]<class T>(T, int j) { store3(s.force, j, load3<T>(s.chain.force, j)); });
  }
  return negative_pivots(s.chain, scratch.factors);
}

}  // namespace ostium::core
