/// Inner rods as layers of their nest's chain.
///
/// Layer k turns with the chain's frames and rolls relative to them: frame Q = exp(psi d3) q, so theta = phi + psi d3.
/// A joint of it with stiffness H and moment m has the energy of a rod's joint (solver/block_tridiagonal.h) in theta;
/// therefore
///   phi    gets H, m as usual,
///   psi_e  gets  b = H d3,  k = d3 . H d3  from both of its joints and  torque = d3 . (m_e+1 - m_e),
///   (e, e+1) couple by  X = -H + [m]x / 2:  u = X d3_e+1,  w = X^T d3_e,  c = d3_e . X d3_e+1.
#include <algorithm>
#include <cmath>

#include "core/math/rotation.h"
#include "core/nesting/lookup.h"
#include "core/nesting/nest.h"
#include "core/rod/ends.h"
#include "core/rod/joint.h"

namespace ostium::core {

namespace {

EndJoints joints_of_layer(const Nest& nest, const Layer& layer) {
  EndJoints ends = joints_of(nest.s.inputs);
  ends.base = ends.base || nest.trunk != nullptr;
  ends.tip = ends.tip && layer.end == nest.s.inside.elements;
  return ends;
}

/// Visits the joints of a layer with its law: joint(T, i, frame before, frame after, inside others).
template <class Visit>
void for_joints(const State& state, const Nest& nest, const Layer& layer, Visit&& visit) {
  const Field<4>& q = layer.roll < 0 ? nest.s.orientation : layer.orientation;
  const EndJoints ends = joints_of_layer(nest, layer);
  const int last = layer.end > 0 ? layer.end : layer.covered;
  if (ends.base) visit(double{}, 0, layer.base_frame, load4<double>(q, 0), layer.covered > 0 || nest.trunk != nullptr);
  const int shared = layer.end > 0 ? layer.covered + 1 : last;  // earlier joints couple frames that are inside others
  const auto between = [&](bool inside) {
    return [&, inside]<class T>(T t, int i) { visit(t, i, load4<T>(q, i - 1), load4<T>(q, i), inside); };
  };
  if (layer.covered > 0) for_packs(1, shared, between(true));
  for_packs(layer.covered > 0 ? shared : 1, last, between(false));
  if (ends.tip) visit(double{}, last, load4<double>(q, last - 1), state.rods[layer.rod].tip.frame(), false);
}

/// A joint with material damping: from the strain history along a rod's own span, from this step's turns inside others.
template <class T, class Law>
Joint<T> damped_joint(const Law& law, const Nest& nest, const Layer& layer, int i, const Q4<T>& a, const Q4<T>& b,
                      bool inside, double scale) {
  const bool history = !inside && layer.damping_s > 0 && scale > 0;
  V3<T> offset{};
  if (history)
    offset = splat<T>(0.5 / nest.step_s) *
             (splat<T>(4) * load3<T>(nest.own.strain, i) - load3<T>(nest.own.strain_before, i));
  Joint<T> out = joint<T>(law, load3<T>(layer.rest, i), load<T>(nest.s.inside.joint_length.at(0) + i), a, b, i,
                          splat<T>(history ? layer.damping_s : 0), splat<T>(1.5 / nest.step_s), offset);
  if (!inside || layer.viscous == 0 || scale == 0) return out;
  const Field<3>& turn = layer.roll < 0 ? nest.s.turn : layer.turn;
  const V3<T> before = [&] {
    if constexpr (sizeof(T) == sizeof(double))
      if (i == 0) return layer.base_turn;
    return load3<T>(turn, i > 0 ? i - 1 : 0);
  }();
  const V3<T> turning = load3<T>(turn, i) - before;
  out.moment = madd(splat<T>(layer.viscous), out.stiffness * turning, out.moment);
  out.stiffness = splat<T>(1 + layer.viscous) * out.stiffness;
  return out;
}

/// Zeroes the entries of a layer's roll that nothing else writes: at the base, if not held, and from where the rod ends
/// or leaves the others.
void clear(int covered, int elements, Layer& layer, Roll& roll) {
  const auto none = [](auto& field, int i) {
    for (int c = 0; c * field.stride() < static_cast<int>(field.raw().size()); ++c) field.at(c)[i] = 0;
  };
  const auto joint = [&](int i) {
    none(roll.ahead, i), none(roll.behind, i), none(roll.both, i);
    none(layer.before, i), none(layer.after, i), none(layer.rolling, i);
  };
  joint(0);
  for (int i = covered; i <= elements; ++i) {
    joint(i);
    none(roll.with_turn, i), none(roll.torque, i);
  }
  std::fill(roll.beside.raw().begin(), roll.beside.raw().end(), 0.0);
}

}  // namespace

[[gnu::flatten]] void predict_layers(const State& state, Nest& nest) {
  const Field<4>& chain = nest.own.orientation;
  for (int k = 1; k < nest.layer_count; ++k) {
    Layer& layer = nest.layers[k];
    const RodState& own = state.rods[layer.rod];
    const bool moving = nest.s.scheme != TimeScheme::from_rest;
    for_packs(0, layer.covered, [&]<class T>(T, int e) {
      const V3<T> d = director3(load4<T>(chain, e)), turn = load3<T>(nest.s.turn, e);
      const Spot at(layer.from_own, e, T{});
      const T part = load<T>(layer.from_own.part.at(0) + e);
      const Q4<T> q_own = mixed4<T>(own.orientation, at, part), q = swing(director3(q_own), d) * q_own;
      const V3<T> da = director3(pick4<T>(own.orientation, at)), db = director3(pick4<T>(own.orientation, at, 1));
      const auto spin = [&](const Field<3>& turns) {
        const T a = dot(pick3<T>(turns, at), da), b = dot(pick3<T>(turns, at, 1), db);
        return madd(part, b - a, a);
      };
      const T last = spin(own.turn);
      T roll{};
      if (moving) roll = 2.0 * last - spin(own.turn_before) - dot(d, turn);
      store(layer.spin_before.at(0) + e, last);
      store4(layer.orientation, e, turned(turn, small_rotation(roll * d) * q));
      store3(layer.turn, e, madd(roll, d, turn));
    });
    for_packs(layer.covered, layer.end, [&]<class T>(T, int e) {
      store4(layer.orientation, e, load4<T>(nest.s.orientation, e));
      store3(layer.turn, e, load3<T>(nest.s.turn, e));
    });
  }
}

[[gnu::flatten]] void linearise_layers(const State& state, Nest& nest) {
  BlockTridiagonal& chain = nest.s.chain;
  const int elements = nest.s.inside.elements;
  const double geometric = nest.s.geometric == GeometricStiffness::with ? 0.5 : 0;
  for_packs(0, elements + 1, [&]<class T>(T, int i) {
    store6(chain.joint_stiffness, i, S3<T>{});
    store3(chain.joint_moment, i, V3<T>{});
  });
  for (int k = 0; k < nest.layer_count; ++k) {
    Layer& layer = nest.layers[k];
    Roll* roll = layer.roll < 0 ? nullptr : &chain.rolls[layer.roll];
    if (roll) clear(layer.covered, elements, layer, *roll);
    std::visit(
        [&](const auto& law) {
          for_joints(state, nest, layer, [&]<class T>(T, int i, const Q4<T>& a, const Q4<T>& b, bool inside) {
            const Joint<T> j = damped_joint(law, nest, layer, i, a, b, inside, 1);
            store6(chain.joint_stiffness, i, load6<T>(chain.joint_stiffness, i) + j.stiffness);
            store3(chain.joint_moment, i, load3<T>(chain.joint_moment, i) + j.moment);
            if constexpr (sizeof(T) == sizeof(double))
              if (i == 0) layer.base_stiffness = j.stiffness, layer.base_moment = j.moment;
            if (!roll || !inside) return;
            const V3<T> da = director3(a), db = director3(b), Ha = j.stiffness * da, Hb = j.stiffness * db;
            const T half = splat<T>(geometric);
            const V3<T> u = half * cross(j.moment, db) - Hb, w = V3<T>{} - Ha - half * cross(j.moment, da);
            store3(layer.before, i, Ha), store3(layer.after, i, Hb);
            store(layer.rolling.at(0) + i, dot(da, Ha)), store(layer.rolling.at(1) + i, dot(db, Hb));
            store(layer.rolling.at(2) + i, dot(da, j.moment)), store(layer.rolling.at(3) + i, dot(db, j.moment));
            store3(roll->ahead, i, u), store3(roll->behind, i, w);
            store(roll->both.at(0) + i, dot(da, u));
          });
        },
        layer.law);
    if (!roll) continue;
    // Where the rod has left the others, its frame is the chain's and does not roll.
    if (layer.end > 0) {
      const int i = layer.covered;
      store3(roll->ahead, i, V3<double>{});
      roll->both.at(0)[i] = 0;
    }
    for_packs(0, layer.covered, [&]<class T>(T, int e) {
      store3(roll->with_turn, e, load3<T>(layer.after, e) + load3<T>(layer.before, e + 1));
      store(roll->stiffness.at(0) + e, load<T>(layer.rolling.at(1) + e) + load<T>(layer.rolling.at(0) + e + 1));
      store(roll->torque.at(0) + e, load<T>(layer.rolling.at(2) + e + 1) - load<T>(layer.rolling.at(3) + e));
    });
    for (int e = layer.covered; e < elements; ++e) roll->stiffness.at(0)[e] = 1;
  }
}

void add_roll_inertia(Nest& nest) {
  BlockTridiagonal& chain = nest.s.chain;
  const double scale = 1 / (nest.s.step_s * nest.s.step_s);
  for (int k = 1; k < nest.layer_count; ++k) {
    const Layer& layer = nest.layers[k];
    Roll& roll = chain.rolls[layer.roll];
    for_packs(0, layer.covered, [&]<class T>(T, int e) {
      const V3<T> d = director3(load4<T>(nest.s.orientation, e));
      const T inertia = scale * load<T>(layer.polar.at(0) + e);
      const T torque = inertia * (load<T>(layer.spin_before.at(0) + e) - dot(d, load3<T>(layer.turn, e)));
      const V3<T> Id = inertia * d;
      store6(
          chain.stiffness, e,
          load6<T>(chain.stiffness, e) + S3<T>{Id.x * d.x, Id.x * d.y, Id.x * d.z, Id.y * d.y, Id.y * d.z, Id.z * d.z});
      store3(chain.torque, e, madd(torque, d, load3<T>(chain.torque, e)));
      store3(roll.with_turn, e, load3<T>(roll.with_turn, e) + Id);
      store(roll.stiffness.at(0) + e, load<T>(roll.stiffness.at(0) + e) + inertia);
      store(roll.torque.at(0) + e, load<T>(roll.torque.at(0) + e) + torque);
    });
  }
}

[[gnu::flatten]] void update_layers(double fraction, Nest& nest) {
  const BlockTridiagonal& chain = nest.s.chain;
  for (int k = 1; k < nest.layer_count; ++k) {
    Layer& layer = nest.layers[k];
    const Roll& roll = chain.rolls[layer.roll];
    for_packs(0, layer.covered, [&]<class T>(T, int e) {
      const Q4<T> q = load4<T>(layer.orientation, e);
      const V3<T> phi = splat<T>(fraction) * load3<T>(chain.turn, e);
      const V3<T> psi = (fraction * load<T>(roll.turn.at(0) + e)) * director3(q);
      store4(layer.orientation, e, turned(phi, small_rotation(psi) * q));
      store3(layer.turn, e, load3<T>(layer.turn, e) + phi + psi);
    });
    for_packs(layer.covered, layer.end, [&]<class T>(T, int e) {
      store4(layer.orientation, e, load4<T>(nest.s.orientation, e));
      store3(layer.turn, e, load3<T>(nest.s.turn, e));
    });
  }
}

double largest_layer_angle(const Nest& nest) {
  double most = 0;  // of sin^2(angle / 2)
  for (int k = 0; k < nest.layer_count; ++k) {
    const Layer& layer = nest.layers[k];
    const Field<4>& q = layer.roll < 0 ? nest.s.orientation : layer.orientation;
    Lanes packed{};
    for_packs(1, layer.end > 0 ? layer.end : layer.covered, [&]<class T>(T, int i) {
      const Q4<T> r = conjugate(load4<T>(q, i - 1)) * load4<T>(q, i);
      const T sine2 = madd(r.x, r.x, madd(r.y, r.y, r.z * r.z));
      if constexpr (sizeof(T) == sizeof(double))
        most = largest(most, sine2);
      else
        packed = largest(packed, sine2);
    });
    most = largest(most, horizontal_max(packed));
  }
  return 2 * std::asin(std::sqrt(std::min(1.0, most)));
}

[[gnu::flatten]] void measure_layers(const State& state, Nest& nest) {
  if (nest.s.strain.size() > 0) {
    store3(nest.s.strain, 0, V3<double>{});
    for (const Span& span : nest.spans) store3(nest.s.strain, span.at + span.elements, V3<double>{});
  }
  for (int k = 0; k < nest.layer_count; ++k) {
    Layer& layer = nest.layers[k];
    store3(layer.moment, 0, V3<double>{});
    store3(layer.moment, layer.end > 0 ? layer.end : layer.covered, V3<double>{});
    std::visit(
        [&](const auto& law) {
          for_joints(state, nest, layer, [&]<class T>(T, int i, const Q4<T>& a, const Q4<T>& b, bool inside) {
            const Joint<T> j = damped_joint(law, nest, layer, i, a, b, inside, 1);
            store3(layer.moment, i, j.moment);
            if (!inside && nest.s.strain.size() > 0) store3(nest.s.strain, i, j.strain);
          });
        },
        layer.law);
  }
}

}  // namespace ostium::core
