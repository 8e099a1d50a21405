/// The outer rod's side of the binding.
#include <algorithm>
#include <cmath>

#include "core/binding/binding.h"
#include "core/binding/geometry.h"
#include "core/math/rotation.h"
#include "core/rod/inertia.h"
#include "core/solve/node_spring.h"
#include "core/tunables.h"

namespace ostium {

namespace {

/// How the inner rod would move in the step if its acceleration, and how fast it crosses its bore, stayed as they are:
/// what its outer rod would do that followed it. Written to `moves`.
void moves_of_inner(const Rod& inner, const RodState& state, double step_s, TimeScheme scheme, Field<3>& moves) {
  keep_acceleration(inner, state, step_s, scheme, moves);
  for_packs(inner.first, inner.nodes(), [&]<class T>(T, int i) {
    const V3<T> crossing = load3<T>(state.offset, i) - load3<T>(state.offset_before, i);
    store3(moves, i, load3<T>(moves, i) - load3<T>(state.position, i) - crossing);
  });
  // What protrudes crosses no bore, but goes along with what is inside.
  int last = inner.elements;
  while (last > inner.first && dot(load3<double>(state.offset, last), load3<double>(state.offset, last)) == 0) --last;
  const V3<double> crossing = load3<double>(state.offset, last) - load3<double>(state.offset_before, last);
  for (int i = last + 1; i <= inner.elements; ++i) store3(moves, i, load3<double>(moves, i) - crossing);
}

/// Makes `b.whole` the outer rod and what protrudes from its tip of the first inner rod that does, up to tunables.h.
void extend(const Model& model, const State& state, std::size_t r, Scratch& scratch, BindingScratch& b) {
  const Rod& rod = scratch.rods[r].inside;
  const int N = rod.elements;
  Rod& whole = b.whole;
  whole.first = rod.first, whole.elements = N;
  for (int i = rod.first; i <= N; ++i) {
    b.depth.at(0)[i] = depth(rod, i);
    b.cell.at(0)[i] = rod.joint_length.at(0)[i];
    if (i < N) whole.length.at(0)[i] = rod.length.at(0)[i];
  }
  b.beyond = -1;
  if (scratch.rods[r].inputs.tip.hold != Hold::free) return;
  for (const Nesting& n : model.nestings) {
    if (n.outer != static_cast<int>(r) || !is_bound(n, scratch)) continue;
    const Rod& inner = scratch.rods[n.inner].inside;
    int k = inner.first + 1;
    while (k <= inner.elements &&
           depth(inner, k) < rod.total_length_m + tunables::least_beyond * inner.length.at(0)[k - 1])
      ++k;
    if (k > inner.elements) continue;
    b.beyond = n.inner, b.beyond_node = k;
    V3<double> p = load3<double>(state.rods[r].position, N);
    for (int e = N; k <= inner.elements && e < N + max_beyond; ++e, ++k) {
      b.depth.at(0)[e + 1] = depth(inner, k);
      const double length = b.depth.at(0)[e + 1] - b.depth.at(0)[e];
      whole.length.at(0)[e] = length;
      b.cell.at(0)[e] = (whole.length.at(0)[e - 1] + length) / 2;
      b.cell.at(0)[e + 1] = length / 2;
      p = madd(length, director3(load4<double>(state.rods[n.inner].orientation, k - 1)), p);
      store3(b.beyond_position, e + 1 - N, p);
      whole.elements = e + 1;
    }
    return;
  }
}

void lend(const Rod& outer, const RodState& inner_state, const Rod& inner, const Field<3>& moves, double lumen_m,
          double inertia, double rate, BindingScratch& b) {
  const double damping = rate * inner.damping.material_time_s;
  int k = inner.first;
  const double inner_tip = inner.total_length_m;
  const auto add = [](Field<3>& field, int i, const V3<double>& x) { store3(field, i, load3<double>(field, i) + x); };
  for (int i = outer.first; i < b.whole.nodes(); ++i) {
    const double at = b.depth.at(0)[i];
    if (at < outer.total_length_m - lumen_m) continue;
    if (at > inner_tip * (1 + 1e-12)) break;
    while (k + 1 < inner.elements && depth(inner, k + 1) <= at) ++k;
    const double behind = depth(inner, k), part = largest(0, least(1, (at - behind) / (depth(inner, k + 1) - behind)));
    const auto here = [&](const Field<3>& field) {
      return madd(part, load3<double>(field, k + 1), (1 - part) * load3<double>(field, k));
    };
    const double cell = b.cell.at(0)[i];
    const double line_mass = inner.mass.at(0)[k] / inner.joint_length.at(0)[k];
    const double spring = cell * (inertia * line_mass + rate * inner.damping.drag_across_N_s_m2);
    b.spring.at(0)[i] += spring;
    add(b.pull, i, spring * here(moves));
    b.bending.at(0)[i] += inner.bending.at(0)[k] / cell;
    b.damping.at(0)[i] += damping * inner.bending.at(0)[k] / cell;
    add(b.moment, i, here(inner_state.moment));
    if (i == b.whole.elements) break;
    const double middle = at + b.whole.length.at(0)[i] / 2;
    int j = k;
    while (j + 1 < inner.elements && depth(inner, j + 1) <= middle) ++j;
    if (middle <= inner_tip) add(b.force, i, load3<double>(inner_state.force, j));
    store3(b.inner_turn, i, load3<double>(inner_state.turn, j));
  }
}

}  // namespace

bool is_bound(const Nesting& nesting, const Scratch& scratch) {
  return scratch.rods[nesting.outer].inside.in_body() && scratch.rods[nesting.inner].inside.in_body();
}

void feel_inner_rods(const Model& model, const State& state, std::size_t r, Scratch& scratch) {
  BindingScratch& b = scratch.bindings[r];
  if (b.bending.size() == 0) return;
  RodScratch& s = scratch.rods[r];
  const RodState& own = state.rods[r];
  const Rod& rod = s.inside;
  const int N = rod.elements;
  for (Field<1>* f : {&b.bending, &b.damping, &b.spring}) std::fill(f->raw().begin(), f->raw().end(), 0.0);
  for (Field<3>* f : {&b.pull, &b.moment, &b.force}) std::fill(f->raw().begin(), f->raw().end(), 0.0);
  b.own_compliance = s.chain.compliance;
  b.own_target = s.target;
  extend(model, state, r, scratch, b);
  const double inertia = acceleration_per_move(s.scheme, model.step_s);
  V3<double> slide{};
  b.carries = false;
  for (const Nesting& n : model.nestings) {
    if (n.outer != static_cast<int>(r) || !is_bound(n, scratch)) continue;
    b.carries = true;
    const Rod& inner = scratch.rods[n.inner].inside;
    Field<3>& moves = scratch.bindings[n.inner].moves;
    moves_of_inner(inner, state.rods[n.inner], model.step_s, s.scheme, moves);
    lend(rod, state.rods[n.inner], inner, moves, n.lumen_m, inertia, velocity_per_move(s.scheme, model.step_s), b);
    if (n.inner != b.beyond) continue;
    // What protrudes is strung from the outer rod's tip: it goes along with it as far as it slides through it.
    const V3<double> t = director3(load4<double>(own.orientation, N - 1));
    const V3<double> tip_move = load3<double>(own.position, N) - load3<double>(own.position_before, N);
    slide = dot(t, tip_move - load3<double>(moves, b.beyond_node)) * t;
  }

  for (int i = rod.first; i < b.whole.nodes(); ++i) {
    const double softness = 1 / b.spring.at(0)[i];
    V3<double> force{};
    if (i <= N) force = load3<double>(own.inner_force, i) + load3<double>(b.correction, i) + drag_on_node(own, rod, i);
    if (i > rod.first) force = force + load3<double>(b.force, i - 1);
    if (i < b.whole.elements) force = force - load3<double>(b.force, i);
    S3<double> P;
    V3<double> target;
    if (i <= N) {
      P = load6<double>(s.chain.compliance, i);
      target = load3<double>(s.target, i) + P * force;
      const M3<double> R = matrix(load4<double>(own.orientation, std::min(i, N - 1)));
      const V3<double> d1{R.r0.x, R.r1.x, R.r2.x}, d2{R.r0.y, R.r1.y, R.r2.y};
      V3<double> place = load3<double>(own.position, i);
      if (b.spring.at(0)[i] > 0) place = madd(softness, load3<double>(b.pull, i), place);
      tie(d1, dot(d1, place), softness, P, target);
      tie(d2, dot(d2, place), softness, P, target);
    } else {
      // Beyond the tip there is the inner rod alone, and it may slide.
      const V3<double> t = director3(load4<double>(state.rods[b.beyond].orientation, b.beyond_node + i - N - 2));
      const double more = 1e3 * softness;
      P = {softness + more * t.x * t.x, more * t.x * t.y, more * t.x * t.z,
           softness + more * t.y * t.y, more * t.y * t.z, softness + more * t.z * t.z};
      target = madd(softness, load3<double>(b.pull, i), load3<double>(b.beyond_position, i - N) + slide) + P * force;
    }
    store6(s.chain.compliance, i, P);
    store3(s.target, i, target);
  }
}

namespace {

/// Stiffness against a turn about the axis d, and against one across it.
template <class T>
S3<T> along_axis(T stiffness, const V3<T>& d) {
  const V3<T> e = stiffness * d;
  return {e.x * d.x, e.x * d.y, e.x * d.z, e.y * d.y, e.y * d.z, e.z * d.z};
}
template <class T>
S3<T> across_axis(T stiffness, const V3<T>& d) {
  const V3<T> e = stiffness * d;
  return {nmadd(e.x, d.x, stiffness), T{} - e.x * d.y, T{} - e.x * d.z,
          nmadd(e.y, d.y, stiffness), T{} - e.y * d.z, nmadd(e.z, d.z, stiffness)};
}

/// m turned by the small rotation vector phi.
template <class T>
V3<T> rotated(const V3<T>& phi, const V3<T>& m) {
  const V3<T> c = cross(phi, m);
  return m + madd(splat<T>(0.5), cross(phi, c), c);
}

}  // namespace

void lend_to_force(const State& state, std::size_t r, Scratch& scratch) {
  BindingScratch& b = scratch.bindings[r];
  if (b.bending.size() == 0) return;
  RodScratch& s = scratch.rods[r];
  const RodState& own = state.rods[r];
  const int N = s.inside.elements;
  for (int j = b.whole.first; j < b.whole.elements; ++j) {
    const V3<double> n = load3<double>(b.force, j);
    Q4<double> q;
    if (j < N) {
      q = load4<double>(own.orientation, j);
      store3(s.force, j, load3<double>(s.force, j) + n);
    } else {
      const RodState& inner = state.rods[b.beyond];
      const int k = b.beyond_node + j - N - 1;
      q = load4<double>(inner.orientation, k);
      V3<double> turn{};
      if (s.scheme != TimeScheme::from_rest) {
        turn = 2.0 * load3<double>(inner.turn, k) - load3<double>(inner.turn_before, k);
        const V3<double> d3 = director3(q);
        const double spin = dot(director3(load4<double>(own.orientation, N - 1)), load3<double>(s.turn, N - 1));
        turn = madd(spin - dot(d3, turn), d3, turn);
      }
      store4(s.orientation, j, turned(turn, q));
      store3(s.turn, j, turn);
      store3(s.force, j, n);
    }
    store4(b.orientation, j, q);
    const V3<double> d = b.whole.length.at(0)[j] * director3(q);
    store3(b.torque, j, load3<double>(b.moment, j) - load3<double>(b.moment, j + 1) - cross(d, n));
  }
  // What protrudes spins with the outer rod's tip: a spin of its own would not bend it, but would look like it.
  std::fill(b.spinning.raw().begin(), b.spinning.raw().end(), 0.0);
  for (int i = N; i < b.whole.elements; ++i) b.spinning.at(0)[i] = 10 * b.bending.at(0)[i];
  // The part of material damping is like a stiffness, less what it does where the inner rods go on as they turned.
  for_packs(b.whole.first + 1, b.whole.elements, [&]<class T>(T, int i) {
    const T viscous = load<T>(b.damping.at(0) + i);
    const V3<T> before = load3<T>(b.inner_turn, i - 1), after = load3<T>(b.inner_turn, i);
    const V3<T> d3 = director3(load4<T>(b.orientation, i));
    const V3<T> v = viscous * cross(director3(load4<T>(b.orientation, i - 1)), d3);
    const V3<T> gone_on = rotated(splat<T>(0.5) * (before + after), v) + across_axis(viscous, d3) * (after - before);
    store3(b.moment, i, load3<T>(b.moment, i) + v);
    store3(b.gone_on, i, gone_on);
  });
}

void own_force(const Rod& rod, const BindingScratch& b, const RodScratch& s, Field<3>& force) {
  if (b.bending.size() == 0) return;
  // Along the rod, what the inner rods do not bear; across it, what its own moments ask for.
  for_packs(rod.first, rod.elements, [&]<class T>(T, int j) {
    const V3<T> d3 = director3(load4<T>(s.orientation, j)), n = load3<T>(s.force, j) - load3<T>(b.force, j);
    const V3<T> moment = load3<T>(s.chain.joint_moment, j + 1) - load3<T>(s.chain.joint_moment, j);
    store3(force, j, madd(dot(n, d3), d3, (1.0 / load<T>(rod.length.at(0) + j)) * cross(d3, moment)));
  });
}

const Rod& solved_rod(const Scratch& scratch, std::size_t r) {
  return scratch.bindings[r].bending.size() > 0 ? scratch.bindings[r].whole : scratch.rods[r].inside;
}

void lend_to_joints(const BindingScratch& b, RodScratch& s) {
  if (b.bending.size() == 0) return;
  const Rod& rod = b.whole;
  Chain& chain = s.chain;
  for (int i = s.inside.nodes(); i < rod.nodes(); ++i) {
    store6(chain.joint_stiffness, i, S3<double>{});
    store3(chain.joint_moment, i, V3<double>{});
  }
  const auto joint = [&]<class T>(T, int i, const V3<T>& turn_before) {
    const V3<T> d3 = director3(load4<T>(s.orientation, i)), turn = load3<T>(s.turn, i);
    const S3<T> H = across_axis(load<T>(b.bending.at(0) + i) + load<T>(b.damping.at(0) + i), d3) +
                    along_axis(load<T>(b.spinning.at(0) + i), d3);
    store6(chain.joint_stiffness, i, load6<T>(chain.joint_stiffness, i) + H);
    const V3<T> moment = rotated(splat<T>(0.5) * (turn + turn_before), load3<T>(b.moment, i));
    store3(chain.joint_moment, i,
           load3<T>(chain.joint_moment, i) + moment + H * (turn - turn_before) - load3<T>(b.gone_on, i));
  };
  if (s.inputs.base.hold == Hold::clamped)
    joint(double{}, rod.first, V3<double>{});
  else
    store3(chain.joint_moment, rod.first, load3<double>(b.moment, rod.first));
  for_packs(rod.first + 1, rod.elements, [&]<class T>(T t, int i) { joint(t, i, load3<T>(s.turn, i - 1)); });
  const int tip = rod.elements;
  store3(chain.joint_moment, tip, load3<double>(chain.joint_moment, tip) + load3<double>(b.moment, tip));
}

void lend_to_elements(const BindingScratch& b, RodScratch& s) {
  if (b.bending.size() == 0) return;
  Chain& chain = s.chain;
  for_packs(b.whole.first, b.whole.elements,
            [&]<class T>(T, int j) { store3(chain.torque, j, load3<T>(chain.torque, j) + load3<T>(b.torque, j)); });
}

}  // namespace ostium
