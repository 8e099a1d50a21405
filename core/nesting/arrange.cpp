/// Decides which rods form a nest, assembles its chain before a step and takes it apart afterwards.
#include <algorithm>
#include <cassert>

#include "core/base/tolerances.h"
#include "core/math/rotation.h"
#include "core/nesting/nest.h"
#include "core/rod/introducer.h"

namespace ostium::core {

namespace {

/// Whether the rods are arranged as in the last step. Interpolation and cells depend on this alone.
bool lie_as_before(const State& state, Nest& nest) {
  bool same = true;
  for (int k = 0; k < max_layers; ++k) {
    Laid now;
    if (k < nest.layer_count) {
      const Layer& layer = nest.layers[k];
      const RodState& own = state.rods[layer.rod];
      now = {layer.rod, own.first, own.exposed, layer.inserted_m, nest.fork_m};
    }
    same = same && now == nest.laid[k];
    nest.laid[k] = now;
  }
  return same;
}

/// The part of the rod's fields that belongs to a span.
struct Part {
  const Span& span;
  int skipped;  ///< 1: its first node belongs to the span before, or to the trunk

  explicit Part(const Nest& nest, const Span& s) : span(s), skipped(&s == &nest.spans.front() && !nest.trunk ? 0 : 1) {}
  int first() const { return span.first; }
  int end() const { return span.first + span.elements; }

  /// Calls take(field of the rod, field of the chain, first, end, at).
  template <class Rod_, class Chain_, class Take>
  void fields(Rod_& rod, Chain_& chain, Take&& take) const {
    const auto nodes = [&](auto& a, auto& b) {
      if (b.size() > 0 && a.size() > 0) take(a, b, first() + skipped, end() + 1, span.at + skipped);
    };
    const auto elements = [&](auto& a, auto& b) { take(a, b, first(), end(), span.at); };
    nodes(rod.position, chain.position), nodes(rod.position_before, chain.position_before);
    nodes(rod.velocity, chain.velocity), nodes(rod.velocity_before, chain.velocity_before);
    nodes(rod.strain, chain.strain), nodes(rod.strain_before, chain.strain_before);
    nodes(rod.wall_force, chain.wall_force), nodes(rod.wall_slip, chain.wall_slip);
    nodes(rod.rod_force, chain.rod_force);
    elements(rod.orientation, chain.orientation), elements(rod.force, chain.force);
    elements(rod.turn, chain.turn), elements(rod.turn_before, chain.turn_before);
  }
};

void gather(const State& state, Scratch& scratch, Nest& nest) {
  for (const Span& span : nest.spans)
    Part(nest, span).fields(state.rods[span.rod], nest.own, [](const auto& from, auto& to, int begin, int end, int at) {
      copy_entries(from, begin, end, to, at);
    });
  const int lead = nest.members.front(), last = nest.spans.back().rod;
  nest.own.base = state.rods[lead].base, nest.own.tip = state.rods[last].tip;
  nest.own.first = 0;
  nest.s.inputs = scratch.rods[lead].inputs;
  nest.s.inputs.tip = scratch.rods[last].inputs.tip;
  if (nest.trunk) {
    nest.s.inputs.base = {.hold = Hold::pinned};
    nest.own.base = {.hold = Hold::pinned};
    gather_root(nest);
  }
  nest.s.scheme = TimeScheme::bdf2;
  for (int r : nest.members)
    if (scratch.rods[r].scheme == TimeScheme::fresh) nest.s.scheme = TimeScheme::fresh;
  nest.s.step_s = nest.step_s;
}

/// The last rod around layer k whose lumen holds it at chain element e; where none does, as behind the port of a
/// balloon that has left its guide, the last that is there, beside whose shaft it lies. -1: beyond all of them, as the
/// end of a layer within the last element of a bore may be.
int host(const Model& model, const Nest& nest, int k, int e) {
  int beside = -1;
  for (int o = k - 1; o >= 0; --o) {
    const Layer& outer = nest.layers[o];
    if (e >= std::max(outer.covered, outer.end)) continue;
    if (beside < 0) beside = o;
    for (const Nesting& n : model.nestings)
      if (n.outer == outer.rod && n.inner == nest.layers[k].rod &&
          nest.depth.at(0)[e + 1] > outer.inserted_m - n.lumen_m)
        return o;
  }
  return beside;
}

/// Finds the bore that each element of the layer is in, and the clearance there.
void find_hosts(const Model& model, Nest& nest, int k) {
  Layer& layer = nest.layers[k];
  for (int e = 0; e < layer.covered; ++e) {
    const int h = host(model, nest, k, e);
    layer.host[e] = std::max(h, 0);
    layer.room.at(0)[e] = 0;
    if (h < 0) continue;
    const Layer& outer = nest.layers[h];
    const Rod& bore = model.rods[outer.rod];
    const int j = e < outer.covered ? outer.from_own.before[e] : bore.elements - outer.end + e;
    assert(j >= 0 && j < bore.elements);
    layer.room.at(0)[e] = largest(0, bore.bore.at(0)[j] - model.rods[layer.rod].radius.at(0)[layer.from_own.before[e]]);
  }
}

/// Finds the entries on either side of `where`, for increasing positions; `at(i)`: position of entry i, up to `last`.
template <class At>
void place(double where, int last, int& hint, At&& at, int i, Places& out) {
  while (hint < last - 1 && at(hint + 1) < where) ++hint;
  const double a = at(hint), b = at(hint + 1);
  out.before[i] = hint;
  out.part.at(0)[i] = std::clamp((where - a) / (b - a), 0.0, 1.0);
}

}  // namespace

double middle_of_own(const Rod& rod, const RodState& s, int j, double reach_m) {
  double from = s.inserted_m - rod.node_from_tip_m[j];
  if (j == s.first) from = 0;
  if (j == s.exposed) from = reach_m;
  return (from + s.inserted_m - rod.node_from_tip_m[j + 1]) / 2;
}

namespace {

/// The branch inside which the rod goes on beyond the trunk; null: none.
const Nest* inside_branch(const Nest& trunk, int rod) {
  for (int b = 0; b < trunk.branch_count; ++b) {
    const std::vector<int>& members = trunk.branches[b]->members;
    if (std::find(members.begin() + 1, members.end(), rod) != members.end()) return trunk.branches[b];
  }
  return nullptr;
}

/// Sets which of a rod's nodes and elements lie along the nest: those inside others, on its side of a fork.
void share_out(const Model& model, const State& state, const Scratch& scratch, const Nest& nest, Layer& layer) {
  const Rod& rod = model.rods[layer.rod];
  const RodState& own = state.rods[layer.rod];
  const int covered = std::min(own.exposed, rod.elements);
  layer.first_node = layer.first_element = own.first;
  layer.end_node = covered + 1, layer.end_element = covered;
  const Nest* branch = nest.trunk ? &nest : inside_branch(nest, layer.rod);
  if (!branch) return;
  int node = own.first, element = own.first;
  while (node < layer.end_node && own.inserted_m - rod.node_from_tip_m[node] <= branch->fork_m) ++node;
  while (element < layer.end_element &&
         middle_of_own(rod, own, element, scratch.exits[layer.rod].depth_m) <= branch->fork_m)
    ++element;
  if (nest.trunk)
    layer.first_node = node, layer.first_element = element;
  else
    layer.end_node = node, layer.end_element = element;
}

/// Lays a nest's chain: spans, cells, and the rods' state on it.
void assemble(const Model& model, State& state, Scratch& scratch, Nest& nest) {
  nest.step_s = scratch.step_s;
  lay_spans(model, scratch, state, nest);
  nest.moved = !lie_as_before(state, nest);
  for (int k = 0; k < nest.layer_count; ++k)
    if (nest.layers[k].end == 0) end_inside(nest, nest.layers[k]);
  if (nest.moved) {
    lay_layers(model, scratch, nest);
    for (int e = 0; e < nest.s.inside.elements; ++e) {
      const double length = nest.s.inside.length.at(0)[e];
      nest.nearness.at(0)[e] = length / (length + tolerances::bore_smooth_m);
    }
  }
  gather(state, scratch, nest);
  nest.s.chain.roll_count = nest.layer_count - 1;
  for (int k = 0; k < nest.layer_count; ++k) {
    Layer& layer = nest.layers[k];
    layer.base_frame = state.rods[layer.rod].base.frame();
    layer.base_turn = from_eigen(nest.step_s * scratch.rods[layer.rod].inputs.base.turn_rate_W_rad_s);
    if (!nest.moved) continue;
    share_out(model, state, scratch, nest, layer);
    if (k == 0) continue;
    const Rod& rod = model.rods[layer.rod];
    const RodState& own = state.rods[layer.rod];
    int hint = own.first;
    for (int e = 0; e < layer.covered; ++e)
      place((nest.depth.at(0)[e] + nest.depth.at(0)[e + 1]) / 2, rod.elements - 1, hint,
            [&](int j) { return middle_of_own(rod, own, j, scratch.exits[layer.rod].depth_m); }, e, layer.from_own);
    find_hosts(model, nest, k);
  }
}

}  // namespace

void arrange(const Model& model, const std::vector<char>& was_in_body, State& state, Scratch& scratch) {
  find_strands(model, was_in_body, state, scratch);
  for (const Strand& strand : scratch.strands) {
    if (!strand.nest) continue;
    assemble(model, state, scratch, *strand.nest);
    if (strand.nest->trunk) weigh_root(*strand.nest, *strand.nest->trunk);
  }
}

void take_apart(const Nest& nest, State& state) {
  for (const Span& span : nest.spans)
    Part(nest, span).fields(state.rods[span.rod], nest.own, [](auto& to, const auto& from, int begin, int end, int at) {
      copy_entries(from, at, at + end - begin, to, begin);
    });
}

NodeOfRod node_of_rod(const Strand& strand, int i) {
  if (!strand.nest) return {strand.lead, i};
  for (const Span& span : strand.nest->spans)
    if (i <= span.at + span.elements) return {span.rod, span.first + i - span.at};
  return {strand.lead, i};
}

}  // namespace ostium::core
