#include "core/binding/binding.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/rotation.h"
#include "core/rod/elasticity.h"
#include "core/rod/ends.h"
#include "core/rod/inertia.h"
#include "core/solve/node_spring.h"
#include "core/tunables.h"

namespace ostium {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Distance from the introducer to node i, along the rod.
double depth(const Rod& inside, int i) { return i == inside.first ? 0 : inside.total_length_m - inside.node_from_tip_m[i]; }

/// A point of the centreline through the nodes, smooth where the polygon has corners.
struct CentrelinePoint {
  V3<double> p, tangent;
};

/// Curvature vector of the polygon at inner node i.
V3<double> curvature(const Rod& rod, const RodScratch& s, int i) {
  i = std::clamp(i, rod.first + 1, rod.elements - 1);
  return (1 / rod.joint_length.at(0)[i]) *
         (director3(load4<double>(s.orientation, i)) - director3(load4<double>(s.orientation, i - 1)));
}

CentrelinePoint centreline(const Rod& rod, const RodScratch& s, const Field<3>& position, int element, double along) {
  const V3<double> a = load3<double>(position, element), b = load3<double>(position, element + 1);
  const double length = rod.length.at(0)[element];
  const V3<double> k = 0.5 * (curvature(rod, s, element) + curvature(rod, s, element + 1));
  CentrelinePoint out;
  out.p = madd(-0.5 * along * (1 - along) * length * length, k, madd(along, b - a, a));
  V3<double> t = madd((along - 0.5) * length * length, k, b - a);
  out.tangent = (1 / std::sqrt(dot(t, t))) * t;
  return out;
}

V3<double> across(const V3<double>& tangent, const V3<double>& v) { return madd(-dot(tangent, v), tangent, v); }

/// How the inner rod would move in the step if its acceleration, and how fast it crosses its bore, stayed as they are:
/// what its outer rod would do that followed it. Written to `moves`.
void moves_of_inner(const Rod& inner, const RodState& state, double step_s, TimeScheme scheme, Field<3>& moves) {
  keep_acceleration(inner, state, step_s, scheme, moves);
  for_packs(inner.first, inner.nodes(), [&]<class T>(T, int i) {
    const V3<T> crossing = load3<T>(state.offset, i) - load3<T>(state.offset_before, i);
    store3(moves, i, load3<T>(moves, i) - load3<T>(state.position, i) - splat<T>(tunables::crossing) * crossing);
  });
  // What protrudes crosses no bore, but goes along with what is inside.
  int last = inner.elements;
  while (last > inner.first && dot(load3<double>(state.offset, last), load3<double>(state.offset, last)) == 0) --last;
  const V3<double> crossing = load3<double>(state.offset, last) - load3<double>(state.offset_before, last);
  for (int i = last + 1; i <= inner.elements; ++i) store3(moves, i, load3<double>(moves, i) - tunables::crossing * crossing);
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
    if (n.outer != static_cast<int>(r)) continue;
    const Rod& inner = scratch.rods[n.inner].inside;
    int k = inner.first + 1;
    while (k <= inner.elements && depth(inner, k) < rod.total_length_m + 0.3 * inner.length.at(0)[k - 1]) ++k;
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
  for (const Nesting& n : model.nestings) {
    if (n.outer != static_cast<int>(r)) continue;
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
    if (i <= N) force = load3<double>(own.inner_force, i) + load3<double>(b.correction, i);
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
/// Of a turn across the axis d: stiffness (I - d d^T).
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
}  // namespace

namespace {
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

void take_own_force(const Rod& rod, const BindingScratch& b, RodScratch& s) {
  if (b.bending.size() == 0) return;
  // Along the rod, what the inner rods do not bear; across it, what its own moments ask for.
  for_packs(rod.first, rod.elements, [&]<class T>(T, int j) {
    const V3<T> d3 = director3(load4<T>(s.orientation, j)), n = load3<T>(s.force, j) - load3<T>(b.force, j);
    const V3<T> moment = load3<T>(s.chain.joint_moment, j + 1) - load3<T>(s.chain.joint_moment, j);
    store3(s.force, j, madd(dot(n, d3), d3, (1.0 / load<T>(rod.length.at(0) + j)) * cross(d3, moment)));
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

namespace {

/// Nodes as if they went on as they moved.
void guess(const RodState& last, RodScratch& s) {
  for_packs(s.inside.first, s.inside.nodes(), [&]<class T>(T, int i) {
    const V3<T> r_n = load3<T>(last.position, i);
    const V3<T> move = s.scheme == TimeScheme::from_rest ? V3<T>{} : r_n - load3<T>(last.position_before, i);
    store3(s.position, i, r_n + move);
  });
}

V3<double> node_force(const Field<3>& force, int first, int elements, int i) {
  V3<double> f{};
  if (i < elements) f = load3<double>(force, i);
  if (i > first) f = f - load3<double>(force, i - 1);
  return f;
}

/// Moves where node i would go without internal force, and keeps the chain's gaps in step.
void move_target(int i, const V3<double>& move, RodScratch& s) {
  Field<3>& gap = s.chain.gap;
  if (i > s.chain.first) store3(gap, i - 1, load3<double>(gap, i - 1) - move);
  if (i < s.chain.elements) store3(gap, i, load3<double>(gap, i) + move);
  store3(s.target, i, load3<double>(s.target, i) + move);
}

/// Direction in which a node, or a point at a rim, is pressed against the bore, and whether it is: its offset, and how
/// far the force that it exerted would have pressed it into a soft wall.
V3<double> pressed(const V3<double>& offset, const V3<double>& force) {
  if (dot(force, offset) < 0) return offset;  // it was held back, not pressed
  return madd(1 / tunables::press_N_m, force, offset);
}

class Enclosing {
 public:
  Enclosing(const Rod& inner, const Rod& outer, const RodScratch& outer_s, const Nesting& nesting, int index,
            const Field<3>& position, BindingScratch& b)
      : inner_(inner), outer_(outer), outer_s_(outer_s), nesting_(nesting), index_(index), position_(position), b_(b) {}

  /// Finds the nodes in this lumen; returns the last of them, or -1.
  int find(int last_free) {
    const double begin = outer_.total_length_m - nesting_.lumen_m;
    int element = outer_.first, last = -1;
    for (int i = inner_.first + 1; i <= last_free; ++i) {
      const double at = depth(inner_, i);
      if (at < begin) continue;
      if (last < 0)
        while (element + 1 < outer_.elements && depth(outer_, element + 1) < at - 2 * outer_.length.at(0)[element]) ++element;
      const V3<double> r = load3<double>(position_, i);
      double along = project(r, element);
      while (along > 1 && element + 1 < outer_.elements) along = project(r, ++element);
      if (along > 1) break;  // beyond the tip
      if (b_.nesting[i] < 0 && along >= 0) {
        b_.nesting[i] = index_, b_.element[i] = element, b_.along.at(0)[i] = along;
      }
      if (b_.nesting[i] < 0) b_.nesting[i] = index_, b_.element[i] = element, b_.along.at(0)[i] = 0;
      last = i;
    }
    return last;
  }

 private:
  double project(const V3<double>& r, int element) const {
    const V3<double> a = load3<double>(outer_s_.position, element), d = load3<double>(outer_s_.position, element + 1) - a;
    return dot(r - a, d) / dot(d, d);
  }

  const Rod &inner_, &outer_;
  const RodScratch& outer_s_;
  const Nesting& nesting_;
  int index_;
  const Field<3>& position_;
  BindingScratch& b_;
};

/// Ties node i along `normal`. Its force turns with it about the lumen's centre, which stays it like a pendulum.
void set_tie(int i, const V3<double>& normal, double force_N, BindingScratch& b) {
  store3(b.normal, i, normal);
  b.softness.at(0)[i] = b.wall.at(0)[i];
  b.stay.at(0)[i] = largest(0, force_N) / largest(b.room.at(0)[i], 1e-9);
}

void find_ties(const Model& model, const Rod& rod, const RodState& state, const std::vector<NestingState>& nestings,
               const Scratch& scratch, double inertia, BindingScratch& b) {
  for (int i = rod.first; i < rod.nodes(); ++i) {
    b.softness.at(0)[i] = infinite, b.stay.at(0)[i] = 0;
    if (b.nesting[i] < 0) continue;
    const RodScratch& outer = scratch.rods[model.nestings[b.nesting[i]].outer];
    const int element = b.element[i];
    const CentrelinePoint c = centreline(outer.inside, outer, outer.position, element, b.along.at(0)[i]);
    store3(b.centre, i, c.p);
    store3(b.tangent, i, c.tangent);
    store3(b.start, i, load3<double>(state.offset, i));
    b.film.at(0)[i] = tunables::rattle * inertia * rod.mass.at(0)[i];
    b.wall.at(0)[i] = 1 / (tunables::bore_N_m2 * rod.joint_length.at(0)[i]);
    b.room.at(0)[i] = outer.inside.bore.at(0)[element] - rod.radius.at(0)[i];
    const V3<double> now = load3<double>(state.offset, i), next = now + (now - load3<double>(state.offset_before, i));
    V3<double> force = load3<double>(state.contact_force, i);
    // A node that has just come in was pressed as the rim was.
    if (dot(now, now) == 0) force = from_eigen(nestings[b.nesting[i]].rim_force_W_N);
    force = across(c.tangent, force);
    const V3<double> press = pressed(across(c.tangent, next), force);
    const double reach = std::sqrt(dot(press, press));
    if (i > b.last || !(reach > b.room.at(0)[i])) continue;
    const V3<double> n = (1 / reach) * press;
    set_tie(i, n, dot(force, n), b);
  }
}

void find_rim(const Model& model, const State& state, int index, int node, const Rod& rod, const Field<3>& position,
              Scratch& scratch, BindingScratch& b, RodScratch& s) {
  const Nesting& nesting = model.nestings[index];
  const RodScratch& outer = scratch.rods[nesting.outer];
  const Rod& tube = outer.inside;
  Rim& rim = b.rims[b.rim_count];
  rim.nesting = index, rim.node = node;
  const CentrelinePoint tip = centreline(tube, outer, outer.position, tube.elements - 1, 1);
  const V3<double> a = load3<double>(position, node), d = load3<double>(position, node + 1) - a;
  rim.along = std::clamp(dot(tip.tangent, tip.p - a) / dot(tip.tangent, d), 0.0, 1.0);
  const V3<double> point = centreline(rod, s, position, node, rim.along).p;
  const V3<double> bulge = point - madd(rim.along, d, a);
  rim.centre = tip.p - bulge;
  rim.tip = tip.p;
  rim.tangent = tip.tangent;
  rim.room = tube.bore.at(0)[tube.elements - 1] - rod.radius.at(0)[node];
  rim.wall = 2 / (tunables::bore_N_m2 * rod.length.at(0)[node]);
  rim.force_N = 0;
  // It is pressed as it was, there or at the node that has just left.
  V3<double> press = from_eigen(state.nestings[index].rim_force_W_N) +
                     load3<double>(state.rods[nesting.inner].contact_force, node + 1);
  press = across(tip.tangent, press);
  rim.edge = d;
  rim.stay = std::sqrt(dot(press, press)) / rim.room;
  if (rim.stay == 0) press = across(tip.tangent, point - tip.p);
  const double reach = std::sqrt(dot(press, press));
  rim.normal = reach > 0 ? (1 / reach) * press : director1(load4<double>(outer.orientation, tube.elements - 1));
  ++b.rim_count;
}

}  // namespace

void find_bores(const Model& model, const State& state, std::size_t r, Scratch& scratch) {
  BindingScratch& b = scratch.bindings[r];
  if (b.nesting.empty()) return;
  RodScratch& s = scratch.rods[r];
  guess(state.rods[r], s);
  const Field<3>& position = s.position;
  const Rod& rod = s.inside;
  std::fill(b.nesting.begin(), b.nesting.end(), -1);
  b.rim_count = 0;
  // The last rod's lumen first: it is the innermost.
  for (int index = static_cast<int>(model.nestings.size()) - 1; index >= 0; --index) {
    const Nesting& nesting = model.nestings[index];
    if (nesting.inner != static_cast<int>(r)) continue;
    const RodScratch& outer = scratch.rods[nesting.outer];
    Enclosing lumen(rod, outer.inside, outer, nesting, index, position, b);
    const int last = lumen.find(rod.elements);
    if (last >= 0 && last < rod.elements && b.nesting[last] == index && b.nesting[last + 1] < 0)
      find_rim(model, state, index, last, rod, position, scratch, b, s);
  }
  b.last = s.inputs.tip.hold == Hold::free ? rod.elements : rod.elements - 1;
  find_ties(model, rod, state.rods[r], state.nestings, scratch, acceleration_per_move(s.scheme, model.step_s), b);
}

namespace {

/// A direction across the unit vector t.
V3<double> beside(const V3<double>& t) {
  const V3<double> axis = std::fabs(t.x) < 0.6 ? V3<double>{1, 0, 0} : V3<double>{0, 1, 0};
  const V3<double> u = cross(t, axis);
  return (1 / std::sqrt(dot(u, u))) * u;
}

/// Puts node i back to where it is free, and ties it again if it is tied; keeps the chain's gaps in step.
void renew_node(int i, BindingScratch& b, RodScratch& s) {
  S3<double> P = load6<double>(b.free_compliance, i);
  V3<double> target = load3<double>(b.free_target, i);
  if (b.nesting[i] >= 0 && i <= b.last) {
    const V3<double> u = beside(load3<double>(b.tangent, i)), w = cross(load3<double>(b.tangent, i), u);
    const V3<double> place = load3<double>(b.centre, i) + load3<double>(b.start, i);
    tie(u, dot(u, place), 1 / b.film.at(0)[i], P, target);
    tie(w, dot(w, place), 1 / b.film.at(0)[i], P, target);
  }
  if (b.softness.at(0)[i] < infinite) {
    const V3<double> n = load3<double>(b.normal, i), e = cross(load3<double>(b.tangent, i), n);
    const V3<double> centre = load3<double>(b.centre, i);
    tie(n, dot(n, centre) + b.room.at(0)[i], b.softness.at(0)[i], P, target);
    tie(e, dot(e, centre), 1 / b.stay.at(0)[i], P, target);
  }
  for (int k = 0; k < b.rim_count; ++k) {
    const Rim& rim = b.rims[k];
    if (i != rim.node && i != rim.node + 1) continue;
    const double part = i == rim.node ? 1 - rim.along : rim.along;
    const V3<double> e = cross(rim.tangent, rim.normal);
    const V3<double> beside = i == rim.node ? -rim.along * rim.edge : (1 - rim.along) * rim.edge;
    tie(e, dot(e, rim.centre + beside), 1 / (part * rim.stay), P, target);
  }
  move_target(i, target - load3<double>(s.target, i), s);
  store6(s.chain.compliance, i, P);
}

}  // namespace

void tie_to_bores(std::size_t r, Scratch& scratch) {
  BindingScratch& b = scratch.bindings[r];
  if (b.nesting.empty()) return;
  RodScratch& s = scratch.rods[r];
  for (int k = 0; k < b.rim_count; ++k) b.rims[k].force_N = 0;
  b.free_compliance = s.chain.compliance;
  b.free_target = s.target;
  b.changes = 0;
  for (int i = s.inside.first; i < s.inside.nodes(); ++i)
    if (b.nesting[i] >= 0) renew_node(i, b, s);
  for (int k = 0; k < b.rim_count; ++k)
    for (int i : {b.rims[k].node, b.rims[k].node + 1}) renew_node(i, b, s);
}

bool change_ties(std::size_t r, Scratch& scratch) {
  BindingScratch& b = scratch.bindings[r];
  if (b.nesting.empty() || b.changes >= tunables::max_tie_changes) return false;
  RodScratch& s = scratch.rods[r];
  const Chain& chain = s.chain;
  const auto solved = [&](int i) {
    return load3<double>(s.target, i) +
           load6<double>(chain.compliance, i) * node_force(chain.force, chain.first, chain.elements, i);
  };
  const bool may_release = b.changes < tunables::max_tie_changes / 2;  // later on, so that no node comes and goes
  bool any = false;
  for (int i = chain.first; i <= b.last; ++i) {
    if (b.nesting[i] < 0) continue;
    const V3<double> offset = across(load3<double>(b.tangent, i), solved(i) - load3<double>(b.centre, i));
    const double room = b.room.at(0)[i];
    const double reach = std::sqrt(dot(offset, offset));
    double force = 0;
    if (b.softness.at(0)[i] < infinite) {
      force = (dot(load3<double>(b.normal, i), offset) - room) / b.softness.at(0)[i];
      if (may_release && force < -tunables::least_pull_N) {
        b.softness.at(0)[i] = infinite;
        renew_node(i, b, s);
        any = true;
        continue;
      }
    }
    if (!(reach > room + largest(0, force) * b.wall.at(0)[i] + tunables::loose_m)) continue;
    set_tie(i, (1 / reach) * offset, force, b);
    renew_node(i, b, s);
    any = true;
  }
  for (int k = 0; k < b.rim_count; ++k) {
    Rim& rim = b.rims[k];
    const V3<double> point = (1 - rim.along) * solved(rim.node) + rim.along * solved(rim.node + 1);
    const V3<double> offset = across(rim.tangent, point - rim.centre);
    const double reach = std::sqrt(dot(offset, offset));
    if (!(reach > rim.room + rim.wall * rim.force_N + tunables::loose_m)) continue;
    rim.normal = (1 / reach) * offset;
    rim.stay = rim.force_N / rim.room;
    any = true;
  }
  if (!any) return false;
  ++b.changes;
  for (int k = 0; k < b.rim_count; ++k) {
    Rim& rim = b.rims[k];
    rim.force_N = 0;
    for (int i : {rim.node, rim.node + 1}) renew_node(i, b, s);
  }
  return true;
}

bool is_inner(const Scratch& scratch, std::size_t r) { return !scratch.bindings[r].nesting.empty(); }

int rim_count(const Scratch& scratch, std::size_t r) { return scratch.bindings[r].rim_count; }

namespace {
/// What a unit force along the rim's normal moves nodes by, at its two nodes, without internal force.
struct RimPush {
  V3<double> before, after;
  RimPush(const Rim& rim, const Chain& chain)
      : before((1 - rim.along) * (load6<double>(chain.compliance, rim.node) * rim.normal)),
        after(rim.along * (load6<double>(chain.compliance, rim.node + 1) * rim.normal)) {}
};

/// Along the rim's normal, of its point, when nodes are at `target` + P (internal force).
double rim_move(const Rim& rim, const Chain& chain, const Field<3>& force, const V3<double>& before,
                const V3<double>& after) {
  const auto node = [&](int i, const V3<double>& target) {
    return dot(rim.normal, target + load6<double>(chain.compliance, i) * node_force(force, chain.first, chain.elements, i));
  };
  return (1 - rim.along) * node(rim.node, before) + rim.along * node(rim.node + 1, after);
}
}  // namespace

ChainLoad& rim_load(std::size_t r, int k, Scratch& scratch) {
  BindingScratch& b = scratch.bindings[r];
  const Chain& chain = scratch.rods[r].chain;
  ChainLoad& load = b.rim_loads[k];
  const Rim& rim = b.rims[k];
  std::fill(load.torque.raw().begin(), load.torque.raw().end(), 0.0);
  std::fill(load.gap.raw().begin(), load.gap.raw().end(), 0.0);
  const RimPush push(rim, chain);
  const auto add = [&](int j, const V3<double>& u) {
    if (j >= chain.first && j < chain.elements) store3(load.gap, j, load3<double>(load.gap, j) + u);
  };
  add(rim.node - 1, V3<double>{} - push.before);
  add(rim.node, push.before - push.after);
  add(rim.node + 1, push.after);
  return load;
}

void take_rim_loads(std::size_t r, Scratch& scratch) {
  BindingScratch& b = scratch.bindings[r];
  RodScratch& s = scratch.rods[r];
  Chain& chain = s.chain;
  double at[max_outer_rods], yield[max_outer_rods][max_outer_rods], change[max_outer_rods] = {};
  for (int k = 0; k < b.rim_count; ++k) {
    const Rim& rim = b.rims[k];
    at[k] = rim_move(rim, chain, chain.force, load3<double>(s.target, rim.node), load3<double>(s.target, rim.node + 1));
    for (int l = 0; l < b.rim_count; ++l) {
      const RimPush push(b.rims[l], chain);
      const auto pushed = [&](int node) {
        return node == b.rims[l].node ? push.before : node == b.rims[l].node + 1 ? push.after : V3<double>{};
      };
      yield[k][l] = rim_move(rim, chain, b.rim_loads[l].force, pushed(rim.node), pushed(rim.node + 1));
    }
  }
  // Forces push inwards only: Gauss-Seidel over one to three numbers.
  for (int sweep = 0; sweep < (b.rim_count > 1 ? 50 : 1); ++sweep)
    for (int k = 0; k < b.rim_count; ++k) {
      Rim& rim = b.rims[k];
      double point = at[k];
      for (int l = 0; l < b.rim_count; ++l) point -= yield[k][l] * change[l];
      const double place = dot(rim.normal, rim.centre) + rim.room;
      change[k] = largest(-rim.force_N, change[k] + (point - place - rim.wall * (rim.force_N + change[k])) / (yield[k][k] + rim.wall));
    }
  for (int k = 0; k < b.rim_count; ++k) {
    Rim& rim = b.rims[k];
    if (change[k] == 0) continue;
    const RimPush push(rim, chain);
    move_target(rim.node, -change[k] * push.before, s);
    move_target(rim.node + 1, -change[k] * push.after, s);
    rim.force_N += change[k];
    const ChainLoad& load = b.rim_loads[k];
    for_packs(chain.first, chain.elements, [&]<class T>(T, int j) {
      const T c = splat<T>(-change[k]);
      store3(chain.turn, j, madd(c, load3<T>(load.turn, j), load3<T>(chain.turn, j)));
      store3(chain.force, j, madd(c, load3<T>(load.force, j), load3<T>(chain.force, j)));
    });
  }
}

namespace {
/// A node that has just met the bore goes on as it moved in this step: second-order differences would throw it back at
/// half the speed that it came with.
void land(const Rod& rod, double step_s, const BindingScratch& b, RodState& state) {
  for (int i = rod.first; i < rod.nodes(); ++i) {
    const V3<double> last = load3<double>(state.contact_force, i);
    if (b.softness.at(0)[i] == infinite || dot(last, last) > 0) continue;
    const V3<double> n = load3<double>(b.normal, i);
    const double u = dot(n, load3<double>(state.position, i) - load3<double>(state.position_before, i)) / step_s;
    for (Field<3>* v : {&state.velocity, &state.velocity_before}) {
      const V3<double> was = load3<double>(*v, i);
      store3(*v, i, madd(u - dot(n, was), n, was));
    }
  }
}
}  // namespace

namespace {

/// Force of node i's tie in the iterate, on the outer rod.
V3<double> tie_force(const RodScratch& s, const BindingScratch& b, int i) {
  if (b.nesting[i] < 0 || i > b.last) return {};
  const V3<double> tangent = load3<double>(b.tangent, i), n = load3<double>(b.normal, i), e = cross(tangent, n);
  const V3<double> offset = across(tangent, load3<double>(s.position, i) - load3<double>(b.centre, i));
  const V3<double> film = b.film.at(0)[i] * (offset - across(tangent, load3<double>(b.start, i)));
  if (b.softness.at(0)[i] == infinite) return film;
  return film + madd((dot(n, offset) - b.room.at(0)[i]) / b.softness.at(0)[i], n, (b.stay.at(0)[i] * dot(e, offset)) * e);
}

V3<double> rim_force(const RodScratch& s, const Rim& rim) {
  const V3<double> before = load3<double>(s.position, rim.node), after = load3<double>(s.position, rim.node + 1);
  const V3<double> e = cross(rim.tangent, rim.normal);
  return madd(rim.force_N, rim.normal, (rim.stay * dot(e, madd(rim.along, after - before, before) - rim.centre)) * e);
}

}  // namespace

void forget_corrections(BindingScratch& b) { std::fill(b.correction.raw().begin(), b.correction.raw().end(), 0.0); }

void measure_binding(const Model& model, Scratch& scratch) {
  for (BindingScratch& b : scratch.bindings) std::fill(b.given.raw().begin(), b.given.raw().end(), 0.0);
  for (std::size_t r = 0; r < model.rods.size(); ++r) {
    BindingScratch& b = scratch.bindings[r];
    if (b.nesting.empty()) continue;
    const RodScratch& s = scratch.rods[r];
    const auto give = [&](int outer, int node, double part, const V3<double>& force) {
      Field<3>& given = scratch.bindings[outer].given;
      store3(given, node, madd(part, force, load3<double>(given, node)));
    };
    for (int i = s.inside.first; i < s.inside.nodes(); ++i) {
      const V3<double> force = tie_force(s, b, i);
      store3(b.force_on_outer, i, force);
      store3(b.on_outer, i, force);
      if (b.nesting[i] < 0) continue;
      const int outer = model.nestings[b.nesting[i]].outer;
      give(outer, b.element[i], 1 - b.along.at(0)[i], force);
      give(outer, b.element[i] + 1, b.along.at(0)[i], force);
    }
    for (int k = 0; k < b.rim_count; ++k) {
      const Rim& rim = b.rims[k];
      const int outer = model.nestings[rim.nesting].outer;
      const V3<double> force = rim_force(s, rim);
      give(outer, model.rods[outer].elements, 1, force);
      store3(b.on_outer, rim.node, madd(1 - rim.along, force, load3<double>(b.on_outer, rim.node)));
      store3(b.on_outer, rim.node + 1, madd(rim.along, force, load3<double>(b.on_outer, rim.node + 1)));
    }
  }
}

bool balance(std::size_t r, int sweep, double step_s, const RodState& state, Scratch& scratch) {
  BindingScratch& b = scratch.bindings[r];
  if (b.bending.size() == 0) return false;
  RodScratch& s = scratch.rods[r];
  const Rod& rod = s.inside;
  linearise_joints(rod, state, joints_of(s.inputs), step_s, s);
  for_packs(rod.first, rod.elements, [&]<class T>(T, int j) {
    const V3<T> d3 = director3(load4<T>(s.orientation, j)), n = load3<T>(s.force, j) - load3<T>(b.force, j);
    const V3<T> moment = load3<T>(s.chain.joint_moment, j + 1) - load3<T>(s.chain.joint_moment, j);
    store3(b.own_force, j, madd(dot(n, d3), d3, (1.0 / load<T>(rod.length.at(0) + j)) * cross(d3, moment)));
  });
  double worst = 0, largest_given = 0, projection = 0, change = 0;
  for (int i = rod.first + 1; i <= rod.elements; ++i) {
    V3<double> taken = inverse(load6<double>(b.own_compliance, i)) * (load3<double>(s.position, i) - load3<double>(b.own_target, i));
    if (i < rod.elements) taken = taken - load3<double>(b.own_force, i);
    taken = taken + load3<double>(b.own_force, i - 1);
    if (!b.nesting.empty()) taken = taken + load3<double>(b.on_outer, i);
    const V3<double> t = director3(load4<double>(s.orientation, std::min(i, rod.elements - 1)));
    const V3<double> owed = across(t, load3<double>(b.given, i) - taken), before = load3<double>(b.owed, i);
    const V3<double> difference = owed - before;
    projection += dot(difference, owed), change += dot(difference, difference);
    store3(b.owed_before, i, before);
    store3(b.owed, i, owed);
    worst = largest(worst, std::sqrt(dot(owed, owed)));
    largest_given = largest(largest_given, std::sqrt(dot(load3<double>(b.given, i), load3<double>(b.given, i))));
  }
  b.mismatch = worst;
  if (worst < largest(tunables::balance_N, tunables::balance_part * largest_given)) return false;
  // Anderson's mixing with one step of memory.
  const double mix = sweep > 1 && change > 0 ? std::clamp(projection / change, -3.0, 0.9) : 0;
  for (int i = rod.first + 1; i <= rod.elements; ++i) {
    const V3<double> owed = load3<double>(b.owed, i);
    V3<double> more = owed;
    if (sweep > 1) more = owed - mix * (load3<double>(b.more, i) + owed - load3<double>(b.owed_before, i));
    store3(b.more, i, more);
    store3(b.correction, i, load3<double>(b.correction, i) + more);
    store3(s.target, i, load3<double>(s.target, i) + load6<double>(s.chain.compliance, i) * more);
  }
  return true;
}

void move_bores(const Model& model, const State& state, std::size_t r, Scratch& scratch) {
  BindingScratch& b = scratch.bindings[r];
  RodScratch& s = scratch.rods[r];
  const Rod& rod = s.inside;
  for (int i = rod.first; i < rod.nodes(); ++i) {
    if (b.nesting[i] < 0) continue;
    const RodScratch& outer = scratch.rods[model.nestings[b.nesting[i]].outer];
    const CentrelinePoint c = centreline(outer.inside, outer, outer.position, b.element[i], b.along.at(0)[i]);
    store3(b.centre, i, c.p);
    store3(b.tangent, i, c.tangent);
    if (b.softness.at(0)[i] == infinite) continue;
    const V3<double> n = across(c.tangent, load3<double>(b.normal, i));
    store3(b.normal, i, (1 / std::sqrt(dot(n, n))) * n);
  }
  for (int k = 0; k < b.rim_count; ++k) {
    Rim& rim = b.rims[k];
    const RodScratch& outer = scratch.rods[model.nestings[rim.nesting].outer];
    const CentrelinePoint tip = centreline(outer.inside, outer, outer.position, outer.inside.elements - 1, 1);
    rim.centre = rim.centre + (tip.p - rim.tip);
    rim.tip = tip.p;
    rim.tangent = tip.tangent;
    const V3<double> n = across(tip.tangent, rim.normal);
    rim.normal = (1 / std::sqrt(dot(n, n))) * n;
  }
  (void)state;
}

void commit_binding(const Model& model, const Scratch& scratch, State& state) {
  if (model.nestings.empty()) return;
  for (NestingState& n : state.nestings) n.rim_force_W_N.setZero();
  for (std::size_t r = 0; r < model.rods.size(); ++r) {
    const BindingScratch& b = scratch.bindings[r];
    RodState& to = state.rods[r];
    for (int i = 0; i < to.inner_force.size(); ++i) store3(to.inner_force, i, load3<double>(b.given, i));
    if (b.nesting.empty()) continue;
    land(scratch.rods[r].inside, model.step_s, b, to);
    for (int i = scratch.rods[r].inside.first; i < model.rods[r].nodes(); ++i) {
      V3<double> offset{};
      if (b.nesting[i] >= 0)
        offset = across(load3<double>(b.tangent, i), load3<double>(to.position, i) - load3<double>(b.centre, i));
      store3(to.offset_before, i, load3<double>(to.offset, i));
      store3(to.offset, i, offset);
      const V3<double> film = b.nesting[i] < 0 || i > b.last ? V3<double>{} : b.film.at(0)[i] * (offset - across(load3<double>(b.tangent, i), load3<double>(b.start, i)));
      store3(to.contact_force, i, load3<double>(b.force_on_outer, i) - film);
    }
    for (int k = 0; k < b.rim_count; ++k)
      state.nestings[b.rims[k].nesting].rim_force_W_N = to_eigen(rim_force(scratch.rods[r], b.rims[k]));
  }
}

}  // namespace ostium
