/// Nodes and frames of inner rods along the chain.
///
/// Nodes lie on the smooth centreline, moved within the clearance to the side of the bore that the rod leans on. Frames
/// turn about the tangent as the layer did, and follow the tangent without further twist.
#include <algorithm>
#include <cmath>

#include "core/base/tolerances.h"
#include "core/math/rotation.h"
#include "core/nesting/lookup.h"
#include "core/nesting/nest.h"

namespace ostium::core {

namespace {

/// Positions of the rod's nodes and element middles on the chain.
void locate(const Rod& rod, const RodState& own, const Nest& nest, Layer& layer) {
  const int elements = nest.s.inside.elements;
  const double* depth = nest.depth.at(0);
  const double reach = depth[layer.covered];
  int e = 0, m = 0;
  const auto middle = [&](int i) { return (depth[i] + depth[i + 1]) / 2; };
  for (int i = layer.first_node; i < layer.end_node; ++i) {
    // The last node may lie a little beyond the bore, where the layer has no entries in this step.
    const double at = i == own.first ? 0 : std::min(layer.inserted_m - rod.node_from_tip_m[i], reach);
    while (e + 1 < elements && depth[e + 1] < at) ++e;
    layer.to_nodes.before[i] = e;
    layer.to_nodes.part.at(0)[i] = std::clamp((at - depth[e]) / (depth[e + 1] - depth[e]), 0.0, 1.0);
  }
  for (int i = layer.first_element; i < layer.end_element; ++i) {
    const double centre = middle_of_own(rod, own, i, reach);
    while (m + 2 < elements && middle(m + 1) < centre) ++m;
    layer.to_elements.before[i] = m;
    const double apart = elements > 1 ? middle(m + 1) - middle(m) : 1;
    layer.to_elements.part.at(0)[i] = std::clamp((centre - middle(m)) / apart, 0.0, 1.0);
  }
}

/// Sideways position of the layer within its clearance, from the bore's contact force: smooth along it, zero at both
/// ends.
void find_lean(const Nest& nest, Layer& layer) {
  const int last = layer.covered;
  const double* depth = nest.depth.at(0);
  const double smooth = tolerances::bore_smooth_m, reach = depth[last];
  layer.room.at(0)[last] = layer.room.at(0)[last - 1];
  for_packs(0, last + 1, [&]<class T>(T, int i) {
    const V3<T> press = load3<T>(layer.press, i);
    const T hard = tolerances::leaning_N_m * load<T>(nest.s.inside.joint_length.at(0) + i);
    const T share = load<T>(layer.room.at(0) + i) / (square_root(dot(press, press)) + hard);
    store3(layer.lean, i, (T{} - share) * press);
  });
  smoothen(nest, last, layer.lean);
  const bool leaves = layer.end > 0 || (nest.branch_count > 0 && layer.inserted_m > reach);
  for_packs(0, last + 1, [&]<class T>(T, int i) {
    const T from_base = load<T>(depth + i) - nest.fork_m,
            end = leaves ? least(from_base, reach - load<T>(depth + i)) : from_base;
    store3(layer.lean, i, least((1 / smooth) * end, splat<T>(1)) * load3<T>(layer.lean, i));
  });
}

/// Frames, motion and internal force of the elements.
void lay_elements(const Nest& nest, const Layer& layer, int first, int last, RodState& own) {
  for_packs(first, last, [&]<class T>(T, int j) {
    const Q4<T> q = load4<T>(own.orientation, j);
    const Spot at(layer.to_elements, j, T{});
    const T part = load<T>(layer.to_elements.part.at(0) + j);
    const V3<T> turn = mixed3<T>(layer.turn, at, part);
    const V3<T> before = director3(pick4<T>(nest.own.orientation, at)),
                after = director3(pick4<T>(nest.own.orientation, at, 1));
    V3<T> d = madd(part, after - before, before);
    d = (1.0 / square_root(dot(d, d))) * d;
    const T spin = dot(d, turn);
    const V3<T> d_before = director3(q);
    store4(own.orientation, j, normalised(swing(d_before, d) * (small_rotation(spin * d_before) * q)));
    store3(own.turn_before, j, load3<T>(own.turn, j));
    store3(own.turn, j, turn);
    store3(own.force, j, mixed3<T>(layer.force, at, part));
  });
}

void lay_nodes(const Rod& rod, const Nest& nest, const Layer& layer, int first, int last, RodState& own) {
  const bool halted = nest.s.step_s < nest.step_s || nest.s.scheme == TimeScheme::from_rest;
  const double per_step = 1 / nest.step_s;
  for_packs(first, last, [&]<class T>(T, int i) {
    const Spot at(layer.to_nodes, i, T{});
    const T part = load<T>(layer.to_nodes.part.at(0) + i), length = pick<T>(nest.s.inside.length.at(0), at);
    const V3<T> a = pick3<T>(nest.own.position, at), b = pick3<T>(nest.own.position, at, 1);
    const V3<T> bend = pick3<T>(nest.bend, at) + pick3<T>(nest.bend, at, 1);
    const V3<T> lean = mixed3<T>(layer.lean, at, part);
    V3<T> offset = load3<T>(own.offset, i);
    offset = madd(splat<T>(1 / tolerances::leaning_steps), lean - offset, offset);
    store3(own.offset, i, offset);
    const V3<T> r = madd((part * (part - 1.0)) * (0.25 * length * length), bend, madd(part, b - a, a)) + offset;
    const V3<T> r_n = load3<T>(own.position, i);
    V3<T> v{};
    if (!halted)
      v = splat<T>(per_step) *
          (splat<T>(1.5) * r - splat<T>(2) * r_n + splat<T>(0.5) * load3<T>(own.position_before, i));
    store3(own.position_before, i, halted ? r : r_n);
    store3(own.position, i, r);
    store3(own.velocity_before, i, halted ? V3<T>{} : load3<T>(own.velocity, i));
    store3(own.velocity, i, v);
    const V3<T> press = mixed3<T>(layer.press, at, part);
    const T share = load<T>(rod.joint_length.at(0) + i) / pick<T>(nest.s.inside.joint_length.at(0), at);
    store3(own.contact_force, i, (T{} - share) * press);
  });
}

/// Strains of joints that may be the rod's own in the next step; they have no history.
void take_strains(const Rod& rod, int from, int to, RodState& own) {
  if (own.strain.size() == 0) return;
  for (int i = std::max(from, own.first + 1); i < std::min(to, rod.elements); ++i) {
    const Q4<double> q = conjugate(load4<double>(own.orientation, i - 1)) * load4<double>(own.orientation, i);
    const V3<double> strain = (1 / rod.joint_length.at(0)[i]) * rotation_vector(q);
    store3(own.strain, i, strain), store3(own.strain_before, i, strain);
  }
}

}  // namespace

[[gnu::flatten]] void spread(const Model& model, Nest& nest, State& state) {
  constexpr int near = 6;
  for (int k = 1; k < nest.layer_count; ++k) {
    Layer& layer = nest.layers[k];
    const Rod& rod = model.rods[layer.rod];
    RodState& own = state.rods[layer.rod];
    const int N = rod.elements, nodes = layer.end_node;
    if (nest.moved) locate(rod, own, nest, layer);
    find_lean(nest, layer);
    lay_elements(nest, layer, layer.first_element, layer.end_element, own);
    lay_nodes(rod, nest, layer, layer.first_node, nodes, own);
    if (!nest.trunk) own.position.set(own.first, own.base.p_W);
    for (int i = layer.first_node; i < nodes && own.rod_force.size() > 0; ++i)
      own.rod_force.set(i, Eigen::Vector3d::Zero());
    for (int i = layer.first_node; i < nodes; ++i) {
      if (own.wall_force.size() == 0) break;
      own.wall_force.set(i, Eigen::Vector3d::Zero()), own.wall_slip.set(i, {0, 0});
    }
    for (int i = std::min(own.exposed, N) + 1; i <= N; ++i) {
      if (own.offset[i].squaredNorm() == 0 && own.contact_force[i].squaredNorm() == 0) continue;
      own.offset.set(i, Eigen::Vector3d::Zero()), own.contact_force.set(i, Eigen::Vector3d::Zero());
    }
    take_strains(rod, layer.first_node, layer.first_node + near, own);
    take_strains(rod, nodes - near, nodes + 1, own);
  }
}

}  // namespace ostium::core
