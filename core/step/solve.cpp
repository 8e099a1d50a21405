#include "core/step/solve.h"

#include <algorithm>

#include "core/base/tolerances.h"
#include "core/contact/contact.h"
#include "core/nesting/nest.h"
#include "core/rod/iterate.h"
#include "core/rod/nodes.h"
#include "core/step/phases.h"

namespace ostium::core {

namespace {

/// Whether the solution is close enough to be taken in full and to decide contact.
bool is_near(Tree tree) {
  return std::all_of(tree.begin(), tree.end(), [](const Strand& strand) {
    const RodScratch& s = *strand.s;
    return s.chain.definite && largest_turn(s.inside, s.chain) <= tolerances::max_turn_rad;
  });
}

/// Solves a whole chain, and another one beside it if there is one.
void solve_first(BlockTridiagonal& chain, BlockTridiagonal* second, Scratch& scratch) {
  const InPhase phase(scratch.clock, first_solving);
  scratch.counts.solves += second ? 2 : 1;
  scratch.counts.eliminated += chain.elements - chain.first + (second ? second->elements - second->first : 0);
  chain.forks = false, chain.pull = {};
  solve(chain, second, scratch.factors);
}

/// Solves a chain that forks; of the trunk no more than the window in which its ties settle.
void solve_forked(Tree tree, Scratch& scratch) {
  RodScratch& trunk = *tree.front().s;
  ContactScratch& c = *tree.front().contact;
  ForkBranch* branches[max_branches];
  for (std::size_t b = 1; b < tree.size(); ++b) {
    RodScratch& s = *tree[b].s;
    move_target(0, load3<double>(trunk.target, trunk.inside.elements) - load3<double>(s.target, 0), s);
    branches[b - 1] = &tree[b].nest->fork;
  }
  const int from = c.window_first < 0 ? -1 : std::max(0, c.window_first - 1);
  const bool within = solve_fork(trunk.chain, scratch.factors, std::span(branches, tree.size() - 1),
                                 trunk.geometric == GeometricStiffness::with ? 0.5 : 0, from);
  if (!within) c.window_first = c.window_last = -1;
  ++scratch.counts.solves;
  for (const Strand& strand : tree)
    scratch.counts.eliminated += is_branch(strand) || !within ? strand.s->inside.elements : trunk.chain.elements - from;
}

/// Solves a chain again whose ties were changed: the window in which they settle, or all but the elements at either end
/// that stayed the same.
void solve_later(BlockTridiagonal& chain, ContactScratch& c, Scratch& scratch) {
  const InPhase phase(scratch.clock, later_solving);
  ++scratch.counts.solves;
  const int from = std::max(chain.first, c.window_first - 1), to = std::min(chain.elements - 1, c.window_last);
  if (c.window_first >= 0 && solve_within(chain, from, to, scratch.factors)) {
    scratch.counts.eliminated += to - from + 1;
    return;
  }
  c.window_first = c.window_last = -1;
  scratch.counts.eliminated += std::max(0, chain.elements - chain.first - 2 * c.same);
  solve_again(chain, c.same, scratch.factors);
}

/// Solves a strand in contact, with its branches, until its ties are those that push.
void solve_held(const Model& model, Tree tree, Scratch& scratch) {
  ContactScratch& c = *tree.front().contact;
  c.changes = c.settling = 0;
  for (const Strand& strand : tree) strand.contact->window_first = strand.contact->window_last = -1;
  BlockTridiagonal& chain = tree.front().s->chain;
  const bool forks = tree.size() > 1;
  if (forks) {
    const InPhase phase(scratch.clock, first_solving);
    solve_forked(tree, scratch);
  } else {
    solve_first(chain, nullptr, scratch);
  }
  const InPhase phase(scratch.clock, changing_ties);
  while (is_near(tree) && change_walls(model, tree, scratch)) {
    if (!forks) {
      solve_later(chain, c, scratch);
      continue;
    }
    const InPhase later(scratch.clock, later_solving);
    solve_forked(tree, scratch);
  }
  complete(chain, scratch.factors);
}

}  // namespace

// Single rods without walls are solved two at a time, since a register holds two.
void solve_open(const Model& model, Scratch& scratch) {
  RodScratch* waiting = nullptr;
  for_trees(scratch, [&](Tree tree) {
    RodScratch& s = *tree.front().s;
    if (s.progress != Progress::open) return;
    if (tree.front().nest || !model.surfaces.empty()) {
      solve_held(model, tree, scratch);
    } else if (!waiting) {
      waiting = &s;
    } else {
      solve_first(waiting->chain, &s.chain, scratch);
      waiting = nullptr;
    }
  });
  if (waiting) solve_first(waiting->chain, nullptr, scratch);
}

namespace {

/// Applies the solution of a chain that forks: the same share of it everywhere.
IterateChange update_all(Tree tree) {
  IterateChange whole;
  for (const Strand& strand : tree) {
    const IterateChange part = measure_solution(strand.s->inside, tolerances::max_turn_rad, strand.s->chain);
    whole.finite = whole.finite && part.finite;
    whole.turn_rad = std::max(whole.turn_rad, part.turn_rad), whole.fraction = std::min(whole.fraction, part.fraction);
  }
  if (!whole.finite) return whole;
  V3<double> pull{};
  for (const Strand& strand : tree) {
    apply_solution(strand.s->inside, whole.fraction, *strand.s);
    update_layers(whole.fraction, *strand.nest);
    if (is_branch(strand)) pull = pull + load3<double>(strand.s->force, 0);
  }
  const RodScratch& trunk = *tree.front().s;
  for (const Strand& strand : tree) {
    RodScratch& s = *strand.s;
    place_nodes(s.inside, is_branch(strand) ? V3<double>{} : pull, s);
    if (is_branch(strand)) store3(s.position, 0, load3<double>(trunk.position, trunk.inside.elements));
    IterateChange part;
    measure_defect(s.inside, s, part);
    whole.stretch = std::max(whole.stretch, part.stretch), whole.defect = std::max(whole.defect, part.defect);
  }
  return whole;
}

/// Applies the solution of one chain.
IterateChange update_one(const Strand& strand) {
  RodScratch& s = *strand.s;
  const IterateChange change = update_iterate(s.inside, tolerances::max_turn_rad, s);
  if (strand.nest && change.finite) update_layers(change.fraction, *strand.nest);
  return change;
}

}  // namespace

void take_solution(Tree tree, RodReport& report, StepCounts& counts) {
  RodScratch& s = *tree.front().s;
  ++report.iterations, ++counts.iterations;
  // A rod loaded beyond buckling within a step would be solved onto the ridge between its buckling directions.
  if (!s.chain.definite && s.geometric == GeometricStiffness::with) {
    for (const Strand& strand : tree) strand.s->geometric = GeometricStiffness::without;
    return;
  }
  const IterateChange change = tree.size() > 1 ? update_all(tree) : update_one(tree.front());
  report.stretch = change.stretch;
  // The defect is quadratic in this iteration's turn, so a small defect means that moments balance, too. A large axial
  // stretch means a rod that has not buckled yet, or cannot.
  const bool whole = change.turn_rad <= tolerances::max_turn_rad;
  for (const Strand& strand : tree) {
    RodScratch& part = *strand.s;
    part.last_defect = part.defect, part.defect = change.defect;
    if (!change.finite)
      part.progress = Progress::failed;
    else if (whole && change.defect <= tolerances::stretch_tolerance &&
             change.stretch <= tolerances::pulled_apart_stretch)
      part.progress = Progress::done;
  }
}

}  // namespace ostium::core
