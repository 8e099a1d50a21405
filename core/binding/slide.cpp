/// Friction between nested rods: against sliding along the bore and against turning in it.
///
/// At each node that is pressed against its bore (and at the one before a rim, for the rim) a spring that slips (see
/// solve/friction.h) ties the inner rod to the outer one's material, along the bore and about it. The inner rod has it
/// in its equations; the outer one is given the force and torque a little later, smoothed over some steps: it is soft
/// in torsion against the springs, and would answer to each of them.
#include <algorithm>

#include "core/binding/binding.h"
#include "core/math/rotation.h"
#include "core/rod/nodes.h"
#include "core/solve/friction.h"
#include "core/tunables.h"

namespace ostium {

namespace {

V3<double> material_move(const RodScratch& s, const RodState& state, int i) {
  return load3<double>(s.position, i) - load3<double>(state.position, i);
}

/// Force that pressed node i against its bore, or against the rim behind it, in the last step.
double load_N(const State& state, std::size_t r, const BindingScratch& b, int i) {
  const V3<double> force = load3<double>(state.rods[r].contact_force, i);
  double load = std::sqrt(dot(force, force));
  for (int k = 0; k < b.rim_count; ++k)
    if (b.rims[k].node == i) load += state.nestings[b.rims[k].nesting].rim_force_W_N.norm();
  return load;
}

/// How the iterate slides, added to the slip that was.
Slip trial_slip(const RodScratch& s, const BindingScratch& b, int i) {
  const double along = dot(load3<double>(b.tangent, i), load3<double>(s.position, i)) - b.slide_place.at(0)[i];
  return {along, s.inside.radius.at(0)[i] * spin_of_node(s, i) - b.slide_place.at(1)[i]};
}

}  // namespace

void find_slides(const Model& model, const State& state, std::size_t r, Scratch& scratch) {
  BindingScratch& b = scratch.bindings[r];
  if (b.nesting.empty()) return;
  const RodScratch& s = scratch.rods[r];
  b.slides = std::any_of(model.nestings.begin(), model.nestings.end(),
                         [&](const Nesting& n) { return n.inner == static_cast<int>(r) && n.friction > 0; });
  std::fill(b.slide_stiffness.raw().begin(), b.slide_stiffness.raw().end(), 0.0);
  if (!b.slides) return;
  move_slides(model, state, r, scratch);
  for (int i = s.inside.first + 1; i < s.inside.nodes(); ++i) {
    if (b.nesting[i] < 0) continue;
    const double friction = model.nestings[b.nesting[i]].friction, load = load_N(state, r, b, i);
    b.slide_stiffness.at(0)[i] = slip_stiffness(friction, load, tunables::bore_slip_m, trial_slip(s, b, i));
  }
  move_slides(model, state, r, scratch);
}

void move_slides(const Model& model, const State& state, std::size_t r, Scratch& scratch) {
  BindingScratch& b = scratch.bindings[r];
  if (!b.slides) return;
  const RodState& own = state.rods[r];
  const Rod& rod = scratch.rods[r].inside;
  for (Field<1>* f : {&b.turn_stiffness, &b.turn_torque}) std::fill(f->raw().begin(), f->raw().end(), 0.0);
  for (int i = rod.first + 1; i < rod.nodes(); ++i) {
    if (b.nesting[i] < 0) continue;
    const int outer = model.nestings[b.nesting[i]].outer, e = b.element[i];
    const RodScratch& bore = scratch.rods[outer];
    const double along = b.along.at(0)[i], radius = rod.radius.at(0)[i], k = b.slide_stiffness.at(0)[i];
    const V3<double> carried = madd(along, material_move(bore, state.rods[outer], e + 1),
                                    (1 - along) * material_move(bore, state.rods[outer], e));
    const V3<double> from = load3<double>(own.position, i) + carried;
    b.slide_place.at(0)[i] = dot(load3<double>(b.tangent, i), from) - own.slip.at(0)[i];
    b.slide_place.at(1)[i] = radius * spin(bore, e) - own.slip.at(1)[i];
    for (int j : {std::max(i - 1, rod.first), std::min(i, rod.elements - 1)}) {
      b.turn_stiffness.at(0)[j] += k * radius * radius / 2;
      b.turn_torque.at(0)[j] += k * radius * b.slide_place.at(1)[i] / 2;
    }
  }
}

void turn_with_bore(std::size_t r, Scratch& scratch) {
  const BindingScratch& b = scratch.bindings[r];
  if (b.nesting.empty() || !b.slides) return;
  RodScratch& s = scratch.rods[r];
  Chain& chain = s.chain;
  for_packs(s.inside.first, s.inside.elements, [&]<class T>(T, int j) {
    const V3<T> d3 = director3(load4<T>(s.orientation, j));
    const T k = load<T>(b.turn_stiffness.at(0) + j);
    const V3<T> kd = k * d3;
    const T torque = load<T>(b.turn_torque.at(0) + j) - dot(kd, load3<T>(s.turn, j));
    store3(chain.torque, j, madd(torque, d3, load3<T>(chain.torque, j)));
    store6(chain.stiffness, j,
           load6<T>(chain.stiffness, j) +
               S3<T>{kd.x * d3.x, kd.x * d3.y, kd.x * d3.z, kd.y * d3.y, kd.y * d3.z, kd.z * d3.z});
  });
}

V3<double> drag_on_node(const RodState& outer, const Rod& inside, int i) {
  V3<double> force{};
  for (int j : {i - 1, i})
    if (j >= inside.first && j < inside.elements)
      force = madd(outer.inner_drag.at(0)[j] / 2, director3(load4<double>(outer.orientation, j)), force);
  return force;
}

void take_drag(const RodState& outer, RodScratch& s) {
  if (outer.inner_drag.size() == 0) return;
  Field<3>& torque = s.chain.torque;
  for_packs(s.inside.first, s.inside.elements, [&]<class T>(T, int j) {
    const V3<T> d3 = director3(load4<T>(s.orientation, j));
    store3(torque, j, madd(load<T>(outer.inner_drag.at(1) + j), d3, load3<T>(torque, j)));
  });
}

void commit_slides(const Model& model, const Scratch& scratch, State& state) {
  const double share = tunables::drag_share;
  for (RodState& rod : state.rods)
    for (double& x : rod.inner_drag.raw()) x *= 1 - share;
  for (std::size_t r = 0; r < model.rods.size(); ++r) {
    const BindingScratch& b = scratch.bindings[r];
    const RodScratch& s = scratch.rods[r];
    if (b.nesting.empty() || !b.slides || !s.inside.in_body()) continue;
    RodState& own = state.rods[r];
    for (int i = s.inside.first; i < s.inside.nodes(); ++i) {
      const double k = b.slide_stiffness.at(0)[i];
      Slip slip;
      if (k > 0) {
        slip = trial_slip(s, b, i);
        Field<2>& drag = state.rods[model.nestings[b.nesting[i]].outer].inner_drag;
        drag.at(0)[b.element[i]] += share * k * slip.along;
        drag.at(1)[b.element[i]] += share * k * slip.around * s.inside.radius.at(0)[i];
        slip = kept(slip, tunables::bore_slip_m);
      }
      own.slip.at(0)[i] = slip.along, own.slip.at(1)[i] = slip.around;
    }
  }
}

}  // namespace ostium
