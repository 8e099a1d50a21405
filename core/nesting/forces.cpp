/// Forces of inner rods on their bores and on the hand.
///
/// The moments of a layer give its transverse force, n = T d3 + (d3 x (m_i+1 - m_i)) / l. The axial balance of its
/// nodes gives the tension T, from where the rod ends or leaves its bore back to the introducer: the bore only presses
/// transversely, and rubs. The remaining transverse force is what it exerts on the bore. In a bend without friction T
/// thus grows by EI k^2 / 2.
#include <cmath>

#include "core/base/tolerances.h"
#include "core/math/rotation.h"
#include "core/nesting/nest.h"

namespace ostium::core {

void smoothen(const Nest& nest, int last, Field<3>& field) {
  const double* near = nest.nearness.at(0);
  V3<double> kept = load3<double>(field, 0);
  // A single multiply-add per node on the dependent chain, since each waits for the previous one.
  const auto take = [&](int i, double own) {
    kept = madd(1 - own, kept, own * load3<double>(field, i));
    store3(field, i, kept);
  };
  for (int i = 1; i <= last; ++i) take(i, near[i - 1]);
  for (int i = last - 1; i >= 0; --i) take(i, near[i]);
}

void find_centreline(Nest& nest) {
  const Rod& chain = nest.s.inside;
  const Field<4>& q = nest.own.orientation;
  for_packs(1, chain.elements, [&]<class T>(T, int i) {
    const V3<T> a = director3(load4<T>(q, i - 1)), b = director3(load4<T>(q, i)), sum = a + b;
    store3(nest.tangent, i, (1.0 / square_root(dot(sum, sum))) * sum);
    store3(nest.bend, i, (1.0 / load<T>(chain.joint_length.at(0) + i)) * (b - a));
  });
  const int N = chain.elements;
  store3(nest.tangent, 0, director3(load4<double>(q, 0)));
  store3(nest.tangent, N, director3(load4<double>(q, N - 1)));
  if (N == 1) store3(nest.bend, 1, V3<double>{});  // of a branch that has just left
  store3(nest.bend, 0, load3<double>(nest.bend, 1));
  store3(nest.bend, N, load3<double>(nest.bend, N - 1));
}

namespace {

template <class T>
V3<T> across(const V3<T>& t, const V3<T>& v) {
  return madd(T{} - dot(t, v), t, v);
}

/// Internal force in a layer's part of the chain's first element; the outermost one has what the others leave.
V3<double> first_force(const Nest& nest, int k) {
  if (k > 0) return load3<double>(nest.layers[k].force, 0);
  V3<double> force = load3<double>(nest.own.force, 0);
  for (int inner = 1; inner < nest.layer_count; ++inner)
    if (nest.layers[inner].covered > 0) force = force - load3<double>(nest.layers[inner].force, 0);
  return force;
}

/// How a layer of a trunk goes on in a branch: the direction and the force of the first element there, and the moment
/// at its root. False if it does not.
struct Beyond {
  V3<double> d3{}, force{}, moment{};
};
bool goes_on(const Nest& trunk, int k, Beyond& out) {
  for (int b = 0; b < trunk.branch_count; ++b) {
    const Nest& branch = *trunk.branches[b];
    for (int j = 0; j < branch.layer_count; ++j) {
      if (branch.beside[j] != k) continue;
      out = {director3(load4<double>(branch.own.orientation, 0)), first_force(branch, j),
             load3<double>(branch.layers[j].moment, 0)};
      return true;
    }
  }
  return false;
}

}  // namespace

void find_layer_forces(const Model& model, Nest& nest) {
  const Rod& chain = nest.s.inside;
  const V3<double> gravity = from_eigen(model.gravity_W);
  for (int k = nest.layer_count - 1; k >= 1; --k) {
    Layer& layer = nest.layers[k];
    const int last = layer.covered;
    // Force at the end of the covered part, where the rod ends or leaves: along d3 and across.
    V3<double> d3_beyond = load3<double>(nest.tangent, last), across_beyond{};
    double tension_beyond = 0;
    if (Beyond on; goes_on(nest, k, on)) {
      d3_beyond = on.d3;
      const V3<double> sum = director3(load4<double>(nest.own.orientation, last - 1)) + on.d3;
      store3(nest.tangent, last, (1 / std::sqrt(dot(sum, sum))) * sum);
      tension_beyond = dot(on.d3, on.force), across_beyond = across(on.d3, on.force);
      store3(layer.moment, last, on.moment);
    } else if (layer.end > 0) {
      V3<double> force = load3<double>(nest.own.force, last);
      for (int inner = k + 1; inner < nest.layer_count; ++inner)
        if (nest.layers[inner].covered > last) force = force - load3<double>(nest.layers[inner].force, last);
      d3_beyond = director3(load4<double>(nest.own.orientation, last));
      tension_beyond = dot(d3_beyond, force), across_beyond = across(d3_beyond, force);
    }

    for_packs(0, last, [&]<class T>(T, int e) {
      const V3<T> d3 = director3(load4<T>(nest.own.orientation, e));
      const V3<T> step = load3<T>(layer.moment, e + 1) - load3<T>(layer.moment, e);
      store3(layer.force, e, (1.0 / load<T>(chain.length.at(0) + e)) * cross(d3, step));
    });
    store3(layer.force, last, across_beyond);
    const auto asked = [&]<class T>(T, int i) {
      const V3<T> acceleration =
          splat<T>(1 / nest.step_s) * (load3<T>(nest.own.velocity, i) - load3<T>(nest.own.velocity_before, i));
      const V3<T> g{splat<T>(gravity.x), splat<T>(gravity.y), splat<T>(gravity.z)};
      const V3<T> inert = load<T>(layer.mass.at(0) + i) * (acceleration - g);
      store3(layer.press, i, inert + load3<T>(layer.force, i - 1) - load3<T>(layer.force, i));
    };
    for_packs(1, last + 1, asked);
    store3(layer.press, 0, V3<double>{});
    for_packs(1, last + 1, [&]<class T>(T, int i) {
      store(layer.along.at(0) + i, dot(load3<T>(nest.tangent, i), load3<T>(layer.press, i)));
    });
    // Where curvature jumps, bending moments give pairs of opposite forces one element apart. The clearance lets a real
    // rod take a longer lever, so the force is spread out.
    for_packs(0, last + 1, [&]<class T>(T, int i) {
      store3(layer.press, i, (1.0 / load<T>(chain.joint_length.at(0) + i)) * load3<T>(layer.press, i));
    });
    smoothen(nest, last, layer.press);
    for_packs(0, last + 1, [&]<class T>(T, int i) {
      store3(layer.press, i, load<T>(chain.joint_length.at(0) + i) * load3<T>(layer.press, i));
    });

    // Axial balance of node i, from the tension after it to that before: before = lever after - gain along.
    const auto weigh = [&]<class T>(T, int i, const V3<T>& d3_after) {
      const V3<T> t = load3<T>(nest.tangent, i);
      const T gain = 1.0 / dot(t, director3(load4<T>(nest.own.orientation, i - 1)));
      store(layer.gain.at(0) + i, gain), store(layer.lever.at(0) + i, gain * dot(t, d3_after));
    };
    for_packs(1, last, [&]<class T>(T t, int i) { weigh(t, i, director3(load4<T>(nest.own.orientation, i))); });
    weigh(double{}, last, d3_beyond);
    const auto pressed = [&]<class T>(T before, T after, int i, const V3<T>& d3_after) {
      const V3<T> d3 = director3(load4<T>(nest.own.orientation, i - 1));
      return across(load3<T>(nest.tangent, i), load3<T>(layer.press, i) + before * d3 - after * d3_after);
    };
    double* tension = layer.tension.at(0);
    tension[last] = tension_beyond;
    for (int i = last; i >= 1; --i) {
      const double after = tension[i], gain = layer.gain.at(0)[i];
      const double free = layer.lever.at(0)[i] * after - gain * layer.along.at(0)[i];
      tension[i - 1] = free;
      const double share = layer.slides ? gain * rubbed_along(model, nest, layer, i) : 0;
      const V3<double> d3_after = i == last ? d3_beyond : director3(load4<double>(nest.own.orientation, i));
      for (int round = 0; round < 2 && share != 0; ++round) {
        const V3<double> press = pressed(tension[i - 1], after, i, d3_after);
        tension[i - 1] = free + share * std::sqrt(dot(press, press));
      }
    }
    const auto press = [&]<class T>(T, int i, const V3<T>& d3_after) {
      const T before = load<T>(tension + i - 1);
      store3(layer.press, i, pressed(before, load<T>(tension + i), i, d3_after));
      const V3<T> d3 = director3(load4<T>(nest.own.orientation, i - 1));
      store3(layer.force, i - 1, madd(before, d3, load3<T>(layer.force, i - 1)));
    };
    for_packs(1, last, [&]<class T>(T t, int i) { press(t, i, director3(load4<T>(nest.own.orientation, i))); });
    press(double{}, last, d3_beyond);
  }
}

void base_load(const Model& model, const Nest& nest, int k, Eigen::Vector3d& force_W_N, Eigen::Vector3d& moment_W_Nm) {
  const Layer& layer = nest.layers[k];
  force_W_N = -to_eigen(first_force(nest, k)) - layer.mass.at(0)[0] * model.gravity_W;
  moment_W_Nm = -layer.moment[0];
}

}  // namespace ostium::core
