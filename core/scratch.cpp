#include "core/scratch.h"

#include <algorithm>

namespace ostium {

namespace {

void resize_outer(const Rod& rod, BindingScratch& b) {
  b.bending.resize(rod.nodes());
  b.damping.resize(rod.nodes());
  b.inner_turn.resize(rod.elements);
  b.moment.resize(rod.nodes());
  b.gone_on.resize(rod.nodes());
  b.force.resize(rod.elements);
  b.torque.resize(rod.elements);
  b.spring.resize(rod.nodes());
  b.pull.resize(rod.nodes());
}

void resize_inner(const Rod& rod, BindingScratch& b) {
  const int nodes = rod.nodes();
  b.nesting.resize(nodes);
  b.element.resize(nodes);
  for (Field<3>* f : {&b.centre, &b.tangent, &b.normal, &b.moves}) f->resize(nodes);
  for (Field<1>* f : {&b.along, &b.room, &b.wall, &b.softness, &b.stay}) f->resize(nodes);
  b.free_compliance.resize(nodes);
  b.free_target.resize(nodes);
  b.rim_loads.assign(max_outer_rods, ChainLoad(rod.elements));
}

}  // namespace

Scratch::Scratch(const Model& model) {
  check(model);
  int longest = 0;
  for (const Rod& rod : model.rods) {
    const int N = rod.elements;
    longest = std::max(longest, N);
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
  factors.resize(longest);

  bindings.resize(rods.size());
  std::vector<std::size_t> group(rods.size(), 0);
  for (std::size_t r = 0; r < rods.size(); ++r) {
    for (const Nesting& n : model.nestings) {
      if (n.inner != static_cast<int>(r)) continue;
      group[r] = std::max(group[r], group[n.outer] + 1);
      resize_inner(model.rods[r], bindings[r]);
      resize_outer(model.rods[n.outer], bindings[n.outer]);
    }
    groups.resize(std::max(groups.size(), group[r] + 1));
    groups[group[r]].push_back(static_cast<int>(r));
  }
}

}  // namespace ostium
