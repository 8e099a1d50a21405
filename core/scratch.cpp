#include "core/scratch.h"

#include <algorithm>

namespace ostium {

namespace {

void resize_outer(const Rod& rod, RodScratch& s, BindingScratch& b) {
  const int N = rod.elements + max_beyond;
  b.whole.length.resize(N);
  b.beyond_position.resize(max_beyond + 1);
  for (Field<1>* f : {&b.depth, &b.cell, &b.bending, &b.spinning, &b.damping, &b.spring}) f->resize(N + 1);
  for (Field<3>* f : {&b.moment, &b.gone_on, &b.pull}) f->resize(N + 1);
  for (Field<3>* f : {&b.force, &b.torque, &b.inner_turn}) f->resize(N);
  b.orientation.resize(N);
  b.own_compliance.resize(N + 1);
  b.own_target.resize(N + 1);
  b.given.resize(rod.nodes());
  for (Field<3>* f : {&b.owed, &b.owed_before, &b.more, &b.correction}) f->resize(rod.nodes());
  b.own_force.resize(rod.elements);
  s.chain = Chain(N);
  for (Field<3>* f : {&s.target, &s.position}) f->resize(N + 1);
  for (Field<3>* f : {&s.turn, &s.force}) f->resize(N);
  s.orientation.resize(N);
}

void resize_inner(const Rod& rod, BindingScratch& b) {
  const int nodes = rod.nodes();
  b.nesting.resize(nodes);
  b.element.resize(nodes);
  for (Field<3>* f : {&b.centre, &b.tangent, &b.normal, &b.moves, &b.on_outer, &b.force_on_outer}) f->resize(nodes);
  for (Field<1>* f : {&b.along, &b.room, &b.wall, &b.softness, &b.stay, &b.slide_stiffness}) f->resize(nodes);
  b.slide_place.resize(nodes);
  b.turn_stiffness.resize(rod.elements);
  b.turn_torque.resize(rod.elements);
}

void resize_contact(const Model& model, const Rod& rod, ContactScratch& c) {
  if (model.surfaces.empty()) return;
  const int nodes = rod.nodes();
  c.walls.resize(nodes);
  c.held.resize(nodes);
  c.rubs.resize(nodes);
  for (Field<1>* f : {&c.travel, &c.stiffness}) f->resize(nodes);
  for (Field<3>* f : {&c.along, &c.across, &c.from}) f->resize(nodes);
  std::size_t clusters = 0;
  for (const Surface& surface : model.surfaces) clusters = std::max(clusters, surface.clusters.size());
  c.clusters.reserve(clusters);
}

}  // namespace

Scratch::Scratch(const Model& model) {
  check(model);
  int longest = 0;
  for (const Rod& rod : model.rods) {
    const int N = rod.elements;
    RodScratch& s = rods.emplace_back();
    s.inside = rod;
    s.chain = Chain(N);
    s.target.resize(N + 1);
    s.position.resize(N + 1);
    s.orientation.resize(N);
    s.turn.resize(N);
    s.force.resize(N);
    if (rod.damping.material_time_s > 0) s.strain.resize(N + 1);
  }

  bindings.resize(rods.size());
  contacts.resize(rods.size());
  for (const Surface& surface : model.surfaces) surfaces.emplace_back(surface);
  std::vector<std::size_t> group(rods.size(), 0);
  for (std::size_t r = 0; r < rods.size(); ++r) {
    for (const Nesting& n : model.nestings) {
      if (n.inner != static_cast<int>(r)) continue;
      group[r] = std::max(group[r], group[n.outer] + 1);
      resize_inner(model.rods[r], bindings[r]);
      resize_outer(model.rods[n.outer], rods[n.outer], bindings[n.outer]);
    }
    groups.resize(std::max(groups.size(), group[r] + 1));
    groups[group[r]].push_back(static_cast<int>(r));
  }
  for (std::size_t r = 0; r < rods.size(); ++r) {
    const int solved = rods[r].chain.elements;  // with what protrudes
    longest = std::max(longest, solved);
    resize_contact(model, model.rods[r], contacts[r]);
    if (!contacts[r].walls.empty()) {
      contacts[r].free_compliance.resize(solved + 1);
      contacts[r].free_target.resize(solved + 1);
    }
    if (bindings[r].nesting.empty()) continue;
    bindings[r].free_compliance.resize(solved + 1);
    bindings[r].free_target.resize(solved + 1);
    bindings[r].rim_loads.assign(max_outer_rods, ChainLoad(solved));
  }
  factors.resize(longest);
}

}  // namespace ostium
