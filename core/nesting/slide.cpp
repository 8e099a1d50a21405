/// Friction between nested rods: against sliding along the bore and against turning in it.
///
/// A spring that slips (solver/friction_spring.h) ties an inner rod to the material of its bore, with the contact force
/// of the last step. How far it slides is known from the lengths fed, so axial friction only transfers force from one
/// rod to the other (forces.cpp). Friction about the axis turns both, and enters the equations of their rolls.
#include <algorithm>
#include <cmath>

#include "core/base/tolerances.h"
#include "core/math/rotation.h"
#include "core/nesting/lookup.h"
#include "core/nesting/nest.h"
#include "core/solver/friction_spring.h"

namespace ostium::core {

namespace {

double friction_with(const Model& model, const Nest& nest, const Layer& layer, int e) {
  const int outer = nest.layers[layer.host[e]].rod;
  for (const Nesting& n : model.nestings)
    if (n.outer == outer && n.inner == layer.rod) return n.friction;
  return 0;
}

/// Angle, rad, by which the layer has turned in its bore during this step.
double turned_in_bore(const Nest& nest, const Layer& layer, int e) {
  const Layer& outer = nest.layers[layer.host[e]];
  const V3<double> with = load3<double>(outer.roll < 0 || e >= outer.covered ? nest.s.turn : outer.turn, e);
  return dot(director3(load4<double>(nest.s.orientation, e)), load3<double>(layer.turn, e) - with);
}

double slid(const Nest& nest, const Layer& layer, int e) { return layer.fed_m - nest.layers[layer.host[e]].fed_m; }

}  // namespace

void find_slides(const Model& model, const State& state, Nest& nest) {
  for (int k = 1; k < nest.layer_count; ++k) {
    Layer& layer = nest.layers[k];
    layer.slides = std::any_of(model.nestings.begin(), model.nestings.end(),
                               [&](const Nesting& n) { return n.inner == layer.rod && n.friction > 0; });
    if (!layer.slides) continue;
    const Rod& rod = model.rods[layer.rod];
    const RodState& own = state.rods[layer.rod];
    for (Field<1>* f : {&layer.grip, &layer.drag}) std::fill(f->raw().begin(), f->raw().end(), 0.0);
    int j = own.first;
    for (int i = 1; i <= layer.covered; ++i) {
      const int e = i - 1;
      const double from_tip = layer.inserted_m - nest.depth.at(0)[i];
      while (j + 2 < rod.nodes() && rod.node_from_tip_m[j + 1] > from_tip) ++j;
      const double part = std::clamp((rod.node_from_tip_m[j] - from_tip) / rod.length.at(0)[j], 0.0, 1.0);
      const auto density = [&](int node) { return own.contact_force[node].norm() / rod.joint_length.at(0)[node]; };
      const double load = nest.s.inside.joint_length.at(0)[i] * ((1 - part) * density(j) + part * density(j + 1));
      const auto at = [&](int c) { return (1 - part) * own.slip.at(c)[j] + part * own.slip.at(c)[j + 1]; };
      layer.slip.at(0)[i] = at(0), layer.slip.at(1)[i] = at(1);
      const double friction = friction_with(model, nest, layer, e);
      if (friction == 0 || load == 0) continue;
      const double radius = rod.radius.at(0)[j];
      const Slip trial{at(0) + slid(nest, layer, e), at(1) + radius * turned_in_bore(nest, layer, e)};
      const double k_N_m = slip_stiffness(friction, load, tolerances::bore_slip_m, trial);
      for (int beside : {e, std::min(i, layer.covered - 1)}) {
        layer.grip.at(0)[beside] += k_N_m * radius * radius / 2;
        layer.drag.at(0)[beside] += k_N_m * radius * at(1) / 2;
      }
    }
  }
}

void turn_in_bores(Nest& nest) {
  for (int k = 1; k < nest.layer_count; ++k) {
    const Layer& layer = nest.layers[k];
    if (!layer.slides) continue;
    Roll& roll = nest.s.chain.rolls[layer.roll];
    for (int e = 0; e < layer.covered; ++e) {
      const double grip = layer.grip.at(0)[e];
      if (grip == 0) continue;
      const double torque = layer.drag.at(0)[e] + grip * turned_in_bore(nest, layer, e);
      roll.stiffness.at(0)[e] += grip;
      roll.torque.at(0)[e] -= torque;
      const Layer& outer = nest.layers[layer.host[e]];
      if (outer.roll < 0 || e >= outer.covered) continue;  // the outer rod turns with the chain's frames
      Roll& other = nest.s.chain.rolls[outer.roll];
      other.stiffness.at(0)[e] += grip;
      other.torque.at(0)[e] += torque;
      if (outer.roll == layer.roll - 1) roll.beside.at(0)[e] -= grip;
    }
  }
}

double rubbed_along(const Model& model, const Nest& nest, const Layer& layer, int i) {
  const int e = std::max(i - 1, 0);
  const double friction = friction_with(model, nest, layer, e);
  if (friction == 0) return 0;
  const double radius = model.rods[layer.rod].radius.at(0)[layer.from_own.before[e]];
  const Slip slip =
      kept({layer.slip.at(0)[i] + slid(nest, layer, e), layer.slip.at(1)[i] + radius * turned_in_bore(nest, layer, e)},
           tolerances::bore_slip_m);
  return -slip_stiffness(friction, 1, tolerances::bore_slip_m, slip) * slip.along;
}

void commit_slides(const Model& model, const Nest& nest, State& state) {
  for (int k = 1; k < nest.layer_count; ++k) {
    const Layer& layer = nest.layers[k];
    if (!layer.slides) continue;
    const Rod& rod = model.rods[layer.rod];
    RodState& own = state.rods[layer.rod];
    const int end = layer.end_node > own.exposed ? rod.nodes() : layer.end_node;  // beyond it, none is left
    for (int i = std::max(own.first + 1, layer.first_node); i < end; ++i) {
      Slip slip;
      if (i <= own.exposed && own.contact_force[i].squaredNorm() > 0) {
        const int e = std::min(layer.to_nodes.before[i], layer.covered - 1);
        const double turned = rod.radius.at(0)[i] * turned_in_bore(nest, layer, e);
        slip = kept({own.slip.at(0)[i] + slid(nest, layer, e), own.slip.at(1)[i] + turned}, tolerances::bore_slip_m);
      }
      own.slip.set(i, {slip.along, slip.around});
    }
  }
}

}  // namespace ostium::core
