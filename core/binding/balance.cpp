/// What nested rods exert on each other: measured, balanced, kept.
#include <algorithm>
#include <cmath>

#include "core/binding/binding.h"
#include "core/binding/geometry.h"
#include "core/contact/contact.h"
#include "core/math/rotation.h"
#include "core/rod/elasticity.h"
#include "core/rod/ends.h"
#include "core/rod/inertia.h"
#include "core/rod/nodes.h"
#include "core/tunables.h"

namespace ostium {

namespace {

/// Force of node i's tie in the iterate, on the outer rod.
V3<double> tie_force(const RodScratch& s, const BindingScratch& b, int i) {
  if (b.softness.at(0)[i] == infinite) return {};
  const V3<double> tangent = load3<double>(b.tangent, i), n = load3<double>(b.normal, i), e = cross(tangent, n);
  const V3<double> offset = across(tangent, load3<double>(s.position, i) - load3<double>(b.centre, i));
  return madd((dot(n, offset) - b.room.at(0)[i]) / b.softness.at(0)[i], n, (b.stay.at(0)[i] * dot(e, offset)) * e);
}

V3<double> rim_force(const RodScratch& s, const Rim& rim) {
  const V3<double> before = load3<double>(s.position, rim.node), after = load3<double>(s.position, rim.node + 1);
  const V3<double> e = cross(rim.tangent, rim.normal);
  return madd(rim.force_N, rim.normal, (rim.stay * dot(e, madd(rim.along, after - before, before) - rim.centre)) * e);
}

}  // namespace

void forget_corrections(BindingScratch& b) {
  b.corrections = 0;
  std::fill(b.correction.raw().begin(), b.correction.raw().end(), 0.0);
}

void measure_binding(const Model& model, Scratch& scratch) {
  for (BindingScratch& b : scratch.bindings) std::fill(b.given.raw().begin(), b.given.raw().end(), 0.0);
  for (std::size_t r = 0; r < model.rods.size(); ++r) {
    BindingScratch& b = scratch.bindings[r];
    if (b.nesting.empty()) continue;
    const RodScratch& s = scratch.rods[r];
    if (!s.inside.in_body()) continue;
    const auto give = [&](int outer, int node, double part, const V3<double>& force) {
      Field<3>& given = scratch.bindings[outer].given;
      store3(given, node, madd(part, force, load3<double>(given, node)));
    };
    for (int i = s.inside.first; i < s.inside.nodes(); ++i) {
      const V3<double> force = tie_force(s, b, i);
      store3(b.force_on_outer, i, force);
      store3(b.on_outer, i, force);
      if (b.softness.at(0)[i] == infinite) continue;
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

bool balance(std::size_t r, double step_s, const RodState& state, Scratch& scratch) {
  BindingScratch& b = scratch.bindings[r];
  if (b.bending.size() == 0 || !b.carries) return false;
  RodScratch& s = scratch.rods[r];
  ContactScratch& contact = scratch.contacts[r];
  const Rod& rod = s.inside;
  linearise_joints(rod, state, joints_of(s.inputs), step_s, s);
  own_force(rod, b, s, b.own_force);
  double worst = 0, largest_given = 0, projection = 0, change = 0;
  for (int i = rod.first + 1; i <= rod.elements; ++i) {
    V3<double> taken =
        inverse(load6<double>(b.own_compliance, i)) * (load3<double>(s.position, i) - load3<double>(b.own_target, i));
    if (i < rod.elements) taken = taken - load3<double>(b.own_force, i);
    taken = taken + load3<double>(b.own_force, i - 1);
    if (!b.nesting.empty()) taken = taken + load3<double>(b.on_outer, i);
    if (!contact.walls.empty()) taken = taken - wall_force(s, contact, i);
    const V3<double> t = director3(load4<double>(s.orientation, std::min(i, rod.elements - 1)));
    const V3<double> owed = across(t, load3<double>(b.given, i) - taken), before = load3<double>(b.owed, i);
    const V3<double> difference = owed - before;
    projection += dot(difference, owed), change += dot(difference, difference);
    store3(b.owed_before, i, before);
    store3(b.owed, i, owed);
    worst = largest(worst, std::sqrt(dot(owed, owed)));
    largest_given = largest(largest_given, std::sqrt(dot(load3<double>(b.given, i), load3<double>(b.given, i))));
  }
  if (worst < largest(tunables::balance_N, tunables::balance_part * largest_given)) return false;
  // Anderson's mixing with one step of memory.
  const double mix = b.corrections > 0 && change > 0 ? std::clamp(projection / change, -3.0, 0.9) : 0;
  for (int i = rod.first + 1; i <= rod.elements; ++i) {
    const V3<double> owed = load3<double>(b.owed, i);
    V3<double> more = owed;
    if (b.corrections > 0) more = owed - mix * (load3<double>(b.more, i) + owed - load3<double>(b.owed_before, i));
    store3(b.more, i, more);
    store3(b.correction, i, load3<double>(b.correction, i) + more);
    store3(s.target, i, load3<double>(s.target, i) + load6<double>(s.chain.compliance, i) * more);
    if (!contact.walls.empty())
      store3(contact.free_target, i,
             load3<double>(contact.free_target, i) + load6<double>(contact.free_compliance, i) * more);
  }
  ++b.corrections;
  return true;
}

void commit_binding(const Model& model, const Scratch& scratch, State& state) {
  if (model.nestings.empty()) return;
  for (NestingState& n : state.nestings) n.rim_force_W_N.setZero();
  for (std::size_t r = 0; r < model.rods.size(); ++r) {
    const BindingScratch& b = scratch.bindings[r];
    RodState& to = state.rods[r];
    if (!scratch.rods[r].inside.in_body()) continue;
    for (int i = 0; i < to.inner_force.size(); ++i) store3(to.inner_force, i, load3<double>(b.given, i));
    if (b.nesting.empty()) continue;
    for (int i = scratch.rods[r].inside.first; i < model.rods[r].nodes(); ++i) {
      const V3<double> last = load3<double>(to.contact_force, i);
      if (b.softness.at(0)[i] < infinite && dot(last, last) == 0) land(i, load3<double>(b.normal, i), model.step_s, to);
      V3<double> offset{};
      if (b.nesting[i] >= 0)
        offset = across(load3<double>(b.tangent, i), load3<double>(to.position, i) - load3<double>(b.centre, i));
      store3(to.offset_before, i, load3<double>(to.offset, i));
      store3(to.offset, i, offset);
      store3(to.contact_force, i, load3<double>(b.force_on_outer, i));
    }
    for (int k = 0; k < b.rim_count; ++k)
      state.nestings[b.rims[k].nesting].rim_force_W_N = to_eigen(rim_force(scratch.rods[r], b.rims[k]));
  }
}

void calm_nests(const Model& model, const Scratch& scratch, State& state) {
  for (const Nesting& n : model.nestings)
    for (int r : {n.outer, n.inner}) {
      if (!is_bound(n, scratch)) continue;
      RodState& rod = state.rods[r];
      halt(scratch.rods[r].inside, rod);
      for (Field<3>* f : {&rod.inner_force, &rod.contact_force, &rod.force, &rod.moment})
        std::fill(f->raw().begin(), f->raw().end(), 0.0);
      for (Field<2>* f : {&rod.slip, &rod.inner_drag}) std::fill(f->raw().begin(), f->raw().end(), 0.0);
      rod.offset_before = rod.offset;
    }
  for (NestingState& n : state.nestings) n.rim_force_W_N.setZero();
}

}  // namespace ostium
