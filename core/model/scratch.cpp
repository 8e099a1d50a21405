#include "core/model/scratch.h"

#include <algorithm>
#include <variant>

#include "core/base/tolerances.h"

namespace ostium::core {

void resize(RodScratch& s, int elements, int rolls, bool damped) {
  s.chain = BlockTridiagonal(elements, rolls);
  s.target.resize(elements + 1);
  s.position.resize(elements + 1);
  s.orientation.resize(elements);
  s.turn.resize(elements);
  s.force.resize(elements);
  if (damped) s.strain.resize(elements + 1);
}

namespace {

void resize_contact(const Model& model, int elements, ContactScratch& c) {
  if (model.rods_touch) c.rod_shares.resize(elements + 1);
  if (model.surfaces.empty()) return;
  const int nodes = elements + 1;
  c.walls.resize(nodes);
  c.rubs.resize(nodes);
  c.changed.resize(nodes);
  c.stiffness.resize(nodes);
  for (Field<3>* f : {&c.expected, &c.along, &c.across, &c.from, &c.anchor, &c.ahead, &c.anchor_push, &c.ahead_push})
    f->resize(nodes);
  c.free_compliance.resize(nodes);
  c.free_target.resize(nodes);
  std::size_t clusters = 0;
  for (const auto& surface : model.surfaces) clusters = std::max(clusters, surface->clusters.size());
  c.clusters.reserve(clusters);
  c.planes_ahead.reserve(static_cast<std::size_t>(nodes) * max_planes);
}

/// Neighbours share a query while they are not far apart: long boxes meet many walls.
Lookouts lookouts_of(const Model& model, const Rod& rod) {
  constexpr double longest_block_m = 16e-3;
  Lookouts made;
  int blocks = 0, in_block = 0;
  double length_m = 0;
  for (int i = 0; i < rod.nodes(); ++i) {
    if (i > 0) length_m += rod.length.at(0)[i - 1];
    if (i == 0 || in_block == most_in_block || length_m > longest_block_m) ++blocks, in_block = 0, length_m = 0;
    made.block.push_back(blocks - 1);
    ++in_block;
  }
  made.leaves.resize(model.surfaces.size() * static_cast<std::size_t>(blocks));
  return made;
}

void resize_layer(int elements, int own_nodes, Layer& l) {
  const int nodes = elements + 1;
  for (Field<1>* f :
       {&l.mass, &l.polar, &l.spin_before, &l.room, &l.grip, &l.drag, &l.along, &l.lever, &l.gain, &l.tension})
    f->resize(nodes);
  for (Field<3>* f : {&l.rest, &l.turn, &l.moment, &l.before, &l.after, &l.force, &l.press, &l.lean}) f->resize(nodes);
  l.orientation.resize(nodes);
  l.rolling.resize(nodes);
  l.slip.resize(nodes);
  l.from_own.resize(nodes);
  l.to_nodes.resize(own_nodes);
  l.to_elements.resize(own_nodes);
  l.host.resize(nodes);
}

/// Whether the rod may lie beside another one in the lumen of a third, so that a chain forks.
bool may_branch(const Model& model, int rod) {
  return std::any_of(model.nestings.begin(), model.nestings.end(), [&](const Nesting& own) {
    return own.inner == rod &&
           (model.fork_from < 2 || std::any_of(model.nestings.begin(), model.nestings.end(), [&](const Nesting& other) {
              return other.outer == own.outer && other.inner != rod && !is_nested(model.nestings, rod, other.inner) &&
                     !is_nested(model.nestings, other.inner, rod);
            }));
  });
}

/// Sizes the nest of the rods that may be around or inside rod `lead`, or of the branch that it leads.
void resize_nest(const Model& model, int lead, Nest& nest) {
  std::vector<int> members{lead};
  for (const Nesting& n : model.nestings)
    if (n.outer == lead) members.push_back(n.inner);
  nest.members.reserve(max_layers);
  const bool branches = may_branch(model, lead);
  if (members.size() == 1 && !branches) return;
  // One extra element for each rod end that falls inside an element of the rod around it.
  int elements = 0, own_nodes = 0;
  bool damped = false;
  for (int r : members) {
    elements += model.rods[r].elements + 1;
    own_nodes = std::max(own_nodes, model.rods[r].nodes());
    damped = damped || model.rods[r].damping.material_time_s > 0;
  }
  const int layers = std::min<int>(static_cast<int>(members.size()), max_layers);
  resize(nest.s, elements, layers - 1, damped);
  for (int rolls = 0; branches && rolls < layers; ++rolls) nest.factors.resize(elements, rolls);
  nest.spans.reserve(layers);
  nest.layers.resize(layers);
  for (Layer& layer : nest.layers) {
    resize_layer(elements, own_nodes, layer);
    layer.law = model.rods[lead].law;
    for (int r : members)  // the most general law includes the others
      if (model.rods[r].law.index() > layer.law.index()) layer.law = model.rods[r].law;
    std::visit([&](auto& law) { law.resize(elements + 1); }, layer.law);
  }
  Rod& chain = nest.s.inside;
  for (Field<1>* f : {&chain.length, &chain.mass, &chain.joint_length, &chain.radius}) f->resize(elements + 1);
  chain.rotary_inertia.resize(elements);
  RodState& own = nest.own;
  for (Field<3>* f : {&own.position, &own.position_before, &own.velocity, &own.velocity_before})
    f->resize(elements + 1);
  for (Field<3>* f : {&own.turn, &own.turn_before, &own.force}) f->resize(elements);
  own.orientation.resize(elements);
  if (damped)
    for (Field<3>* f : {&own.strain, &own.strain_before}) f->resize(elements + 1);
  if (!model.surfaces.empty()) own.wall_force.resize(elements + 1), own.wall_slip.resize(elements + 1);
  if (model.rods_touch) own.rod_force.resize(elements + 1);
  resize_contact(model, elements, nest.contact);
  nest.depth.resize(elements + 1);
  nest.nearness.resize(elements + 1);
  nest.tangent.resize(elements + 1);
  nest.bend.resize(elements + 1);
}

}  // namespace

Scratch::Scratch(const Model& model) : rods(model.rods.size()), contacts(model.rods.size()), nests(model.rods.size()) {
  check(model);
  for (std::vector<int>* of_rods : {&lead, &around, &branch}) of_rods->resize(model.rods.size());
  exits.resize(model.rods.size());
  was_in_body.resize(model.rods.size());
  fed_m.resize(model.rods.size());
  before_drive.resize(model.rods.size());
  strands.reserve(model.rods.size() + 1);
  if (model.rods_touch) rod_contacts.reserve(tolerances::max_rod_contacts);
  for (const auto& surface : model.surfaces) surfaces.emplace_back(*surface);
  for (std::size_t r = 0; r < model.rods.size(); ++r) {
    const Rod& rod = model.rods[r];
    rods[r].inside = rod;
    resize(rods[r], rod.elements, 0, rod.damping.material_time_s > 0);
    resize_contact(model, rod.elements, contacts[r]);
    if (!model.surfaces.empty()) lookouts.push_back(lookouts_of(model, rod));
    factors.resize(rod.elements);
    resize_nest(model, static_cast<int>(r), nests[r]);
    const BlockTridiagonal& chain = nests[r].s.chain;
    for (int rolls = 1; rolls <= static_cast<int>(chain.rolls.size()); ++rolls) factors.resize(chain.elements, rolls);
  }
}

}  // namespace ostium::core
