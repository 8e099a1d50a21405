#include "core/rod/inertia.h"

#include <algorithm>

#include "core/math/rotation.h"
#include "core/rod/iterate.h"

namespace ostium::core {

namespace {

/// Acceleration and velocity as functions of the new position r:  a = A (r - r_a),  v = B (r - r_v).
///
/// bdf2:       v = (3 r - 4 r_n + r_n-1) / 2h,  a = (3 v - 4 v_n + v_n-1) / 2h, so with
///             r_v = (4 r_n - r_n-1) / 3  and  r_a = r_v + (2h / 3) (4 v_n - v_n-1) / 3:
///             A = 9 / 4h^2,  B = 3 / 2h.
/// fresh:      r = r_n + h v_n + h^2 a / 2,  v = v_n + h a, so with  r_v = r_n + h v_n / 2  and  r_a = r_n + h v_n:
///             A = 2 / h^2,  B = 2 / h.
///             After a jump in the forces, bdf2 would carry on obsolete accelerations and lag by h.
/// from_rest:  v = (r - r_n) / h,  a = v / h:
///             A = 1 / h^2,  B = 1 / h.
struct Inertia {
  TimeScheme scheme;
  double step_s;

  double A() const {
    const double scale = scheme == TimeScheme::bdf2 ? 9.0 / 4 : scheme == TimeScheme::fresh ? 2 : 1;
    return scale / (step_s * step_s);
  }
  double B() const { return (scheme == TimeScheme::bdf2 ? 3.0 / 2 : scheme == TimeScheme::fresh ? 2 : 1) / step_s; }

  template <class T>
  static V3<T> extrapolated(const Field<3>& now, const Field<3>& before, int i) {
    return splat<T>(1.0 / 3) * (splat<T>(4) * load3<T>(now, i) - load3<T>(before, i));
  }
  template <class T>
  V3<T> r_v(const RodState& s, int i) const {
    if (scheme == TimeScheme::bdf2) return extrapolated<T>(s.position, s.position_before, i);
    if (scheme == TimeScheme::from_rest) return load3<T>(s.position, i);
    return madd(splat<T>(step_s / 2), load3<T>(s.velocity, i), load3<T>(s.position, i));
  }
  template <class T>
  V3<T> r_a(const RodState& s, const V3<T>& r_v, int i) const {
    if (scheme == TimeScheme::bdf2)
      return madd(splat<T>(2.0 / 3 * step_s), extrapolated<T>(s.velocity, s.velocity_before, i), r_v);
    if (scheme == TimeScheme::from_rest) return r_v;
    return madd(splat<T>(step_s / 2), load3<T>(s.velocity, i), r_v);
  }
};

}  // namespace

/// A node's balance  m a + D v = f + (internal force)  reads  r = target + P (internal force)  with
///   P = (A m + B D)^-1,   target = r_a + P (f + B D (r_v - r_a)).
/// D is the drag of the node's cell, along and across the tangent t, so P = p_across (I - t t^T) + p_along t t^T.
void predict_nodes(const Rod& rod, const Damping& loss, int begin, int end, const RodState& state,
                   const Eigen::Vector3d& gravity_W, double step_s, RodScratch& scratch) {
  const Inertia inertia{scratch.scheme, step_s};
  const bool drag = loss.drag_across_N_s_m2 > 0 || loss.drag_along_N_s_m2 > 0;
  const int N = rod.elements;
  const auto node = [&]<class T>(T, int i) {
    const V3<T> r_v = inertia.r_v<T>(state, i), r_a = inertia.r_a<T>(state, r_v, i);
    const T mass = load<T>(rod.mass.at(0) + i);
    V3<T> force{mass * gravity_W.x(), mass * gravity_W.y(), mass * gravity_W.z()};
    const T m = inertia.A() * mass;
    S3<T> P{1.0 / m, T{}, T{}, 1.0 / m, T{}, 1.0 / m};
    if (drag) {
      const T cell = inertia.B() * load<T>(rod.joint_length.at(0) + i);
      const T across = cell * loss.drag_across_N_s_m2, along = cell * loss.drag_along_N_s_m2;
      V3<T> t = load3<T>(state.position, std::min(i + 1, N)) - load3<T>(state.position, std::max(i - 1, rod.first));
      t = (1.0 / square_root(dot(t, t))) * t;
      const V3<T> slip = r_v - r_a;
      force = force + madd((along - across) * dot(t, slip), t, across * slip);
      const T p_across = 1.0 / (m + across), p = 1.0 / (m + along) - p_across;
      P = {madd(p * t.x, t.x, p_across), p * t.x * t.y, p * t.x * t.z,
           madd(p * t.y, t.y, p_across), p * t.y * t.z, madd(p * t.z, t.z, p_across)};
    }
    store6(scratch.chain.compliance, i, P);
    store3(scratch.target, i, r_a + P * force);
  };
  if (begin == rod.first) node(double{}, rod.first);
  for_packs(std::max(begin, rod.first + 1), std::min(end, N), node);
  if (end == N + 1) node(double{}, N);
}

void add_load(int node, const Eigen::Vector3d& force_W_N, RodScratch& scratch) {
  const V3<double> move = load6<double>(scratch.chain.compliance, node) * from_eigen(force_W_N);
  store3(scratch.target, node, load3<double>(scratch.target, node) + move);
}

void predict_elements(const Rod& rod, const RodState& state, RodScratch& scratch) {
  const bool moving = scratch.scheme != TimeScheme::from_rest;
  for_packs(rod.first, rod.elements, [&]<class T>(T, int j) {
    V3<T> turn{};
    if (moving) turn = splat<T>(2) * load3<T>(state.turn, j) - load3<T>(state.turn_before, j);
    store4(scratch.orientation, j, turned(turn, load4<T>(state.orientation, j)));
    store3(scratch.turn, j, turn);
    store3(scratch.force, j, load3<T>(state.force, j));
  });
}

namespace {
/// J / h^2 of four elements, J = J_t I + (J_s - J_t) d3 d3^T.
template <class T>
S3<T> rotary_inertia(const Rod& rod, const RodScratch& scratch, double scale, int j) {
  const T transverse = scale * load<T>(rod.rotary_inertia.at(0) + j);
  const T polar = scale * load<T>(rod.rotary_inertia.at(1) + j) - transverse;
  const V3<T> d3 = director3(load4<T>(scratch.orientation, j)), pd = polar * d3;
  return {madd(pd.x, d3.x, transverse), pd.x * d3.y, pd.x * d3.z,
          madd(pd.y, d3.y, transverse), pd.y * d3.z, madd(pd.z, d3.z, transverse)};
}
}  // namespace

void add_rotary_inertia(const Rod& rod, double step_s, RodScratch& scratch) {
  Field<6>& K = scratch.chain.stiffness;
  const double scale = 1 / (step_s * step_s);
  for_packs(rod.first, rod.elements,
            [&]<class T>(T, int j) { store6(K, j, load6<T>(K, j) + rotary_inertia<T>(rod, scratch, scale, j)); });
}

/// Backward Euler for angular momentum, omega = turn / h. In bending, J_t is (radius / element length)^2 of the nodes'
/// inertia; in twisting, J_s gives torsional waves faster than a step. The gyroscopic term omega x J omega is
/// neglected: at 10 turns a second it is 1e-9 of a wire's bending moments.
void add_rotary_torque(const Rod& rod, const RodState& state, double step_s, RodScratch& scratch) {
  Field<3>& torque = scratch.chain.torque;
  const double scale = 1 / (step_s * step_s);
  for_packs(rod.first, rod.elements, [&]<class T>(T, int j) {
    const V3<T> change = load3<T>(scratch.turn, j) - load3<T>(state.turn, j);
    store3(torque, j, load3<T>(torque, j) - rotary_inertia<T>(rod, scratch, scale, j) * change);
  });
}

void commit(const Rod& rod, const RodScratch& scratch, double step_s, RodState& state) {
  const Inertia inertia{scratch.scheme, step_s};
  for_packs(rod.first, rod.nodes(), [&]<class T>(T, int i) {
    const V3<T> next = load3<T>(scratch.position, i);
    const V3<T> r_v = inertia.r_v<T>(state, i), v = splat<T>(inertia.B()) * (next - r_v);
    store3(state.position_before, i, load3<T>(state.position, i));
    store3(state.position, i, next);
    store3(state.velocity_before, i, load3<T>(state.velocity, i));
    store3(state.velocity, i, v);
  });
  for_packs(rod.first, rod.elements, [&]<class T>(T, int j) {
    store4(state.orientation, j, load4<T>(scratch.orientation, j));
    store3(state.turn_before, j, load3<T>(state.turn, j));
    store3(state.turn, j, load3<T>(scratch.turn, j));
    store3(state.force, j, load3<T>(scratch.force, j));
  });
  if (state.strain.size() > 0)
    for_packs(rod.first, rod.nodes(), [&]<class T>(T, int i) {
      store3(state.strain_before, i, load3<T>(state.strain, i));
      store3(state.strain, i, load3<T>(scratch.strain, i));
    });
}

void string_iterate(const Rod& rod, const RodState& state, RodScratch& scratch) {
  const bool from_base = state.base.hold != Hold::free || state.tip.hold == Hold::free;
  const Eigen::Vector3d end = state.base.hold != Hold::free  ? state.base.p_W
                              : state.tip.hold != Hold::free ? state.tip.p_W
                                                             : state.position[rod.first];
  string_nodes(rod, scratch.orientation, from_eigen(end), from_base, scratch.position);
}

void commit_at_rest(const Rod& rod, const RodScratch& scratch, RodState& state) {
  for_packs(rod.first, rod.nodes(),
            [&]<class T>(T, int i) { store3(state.position, i, load3<T>(scratch.position, i)); });
  for_packs(rod.first, rod.elements, [&]<class T>(T, int j) {
    store4(state.orientation, j, load4<T>(scratch.orientation, j));
    store3(state.force, j, V3<T>{});
  });
  take_strain(rod, scratch, state);
  halt(rod, state);
}

void take_strain(const Rod& rod, const RodScratch& scratch, RodState& state) {
  if (state.strain.size() == 0) return;
  for_packs(rod.first, rod.nodes(), [&]<class T>(T, int i) { store3(state.strain, i, load3<T>(scratch.strain, i)); });
}

void rescale_history(const Rod& rod, double ratio, RodState& state) {
  const auto rescale = [&](const Field<3>& now, Field<3>& before) {
    if (now.size() == 0) return;
    for_packs(rod.first, rod.nodes(), [&]<class T>(T, int i) {
      const V3<T> at = load3<T>(now, i);
      store3(before, i, madd(splat<T>(ratio), load3<T>(before, i) - at, at));
    });
  };
  rescale(state.position, state.position_before);
  rescale(state.velocity, state.velocity_before);
  rescale(state.strain, state.strain_before);
  for_packs(rod.first, rod.elements, [&]<class T>(T, int j) {
    const V3<T> turn = load3<T>(state.turn, j);
    store3(state.turn, j, splat<T>(ratio) * turn);
    store3(state.turn_before, j, splat<T>(ratio) * madd(splat<T>(ratio), load3<T>(state.turn_before, j) - turn, turn));
  });
}

void halt(const Rod& rod, RodState& state) {
  for_packs(rod.first, rod.nodes(), [&]<class T>(T, int i) {
    store3(state.position_before, i, load3<T>(state.position, i));
    store3(state.velocity, i, V3<T>{});
    store3(state.velocity_before, i, V3<T>{});
    if (state.strain.size() > 0) store3(state.strain_before, i, load3<T>(state.strain, i));
  });
  for_packs(rod.first, rod.elements, [&]<class T>(T, int j) {
    store3(state.turn, j, V3<T>{});
    store3(state.turn_before, j, V3<T>{});
  });
}

}  // namespace ostium::core
