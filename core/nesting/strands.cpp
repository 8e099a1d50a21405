/// Which rods run in one another, and what is solved as one chain, or as one chain that forks.
///
/// The rods of a nest form a tree: each hangs on the last rod around it that is in the body. A nest whose tree has one
/// branch is one chain. Rods that lie side by side in one lumen share its course; once two of them, or what runs in
/// them, have left its tip, the chain forks there: the trunk carries all of them as layers up to its tip, and what each
/// has beyond is a chain of its own that begins at the trunk's last node (solver/fork.h).
#include <algorithm>

#include "core/nesting/nest.h"
#include "core/rod/introducer.h"

namespace ostium::core {

namespace {

long hanging_on(int o, const Nest& nest, const Scratch& scratch) {
  return std::count_if(nest.members.begin(), nest.members.end(), [&](int m) { return scratch.around[m] == o; });
}

/// The rod in whose lumen others lie side by side; -1: none.
int forks_at(const Model& model, const Nest& nest, const Scratch& scratch) {
  const auto most = std::find_if(nest.members.begin(), nest.members.end(),
                                 [&](int m) { return hanging_on(m, nest, scratch) >= model.fork_from; });
  return most == nest.members.end() ? -1 : *most;
}

/// Whether rod r can hang on rod o: it runs in all rods around o, and only one rod of a nest holds others side by side.
bool can_hang(const Model& model, const Scratch& scratch, int r, int o) {
  for (int outer = scratch.around[o]; outer >= 0; outer = scratch.around[outer])
    if (!is_nested(model.nestings, outer, r)) return false;
  const Nest& nest = scratch.nests[scratch.lead[o]];
  if (static_cast<int>(nest.members.size()) >= max_layers) return false;
  const long beside = hanging_on(o, nest, scratch);
  const int fork = forks_at(model, nest, scratch);
  return beside == 0 || ((fork < 0 || fork == o) && beside < max_branches);
}

void find_nests(const Model& model, const State& state, Scratch& scratch) {
  for (int r = 0; r < static_cast<int>(model.rods.size()); ++r) {
    Nest& own = scratch.nests[r];
    own.members.clear();
    own.trunk = nullptr, own.branch_count = 0;
    own.fork_m = own.behind_m = 0;
    scratch.lead[r] = r, scratch.around[r] = -1;
    if (!in_body(model.rods[r], state.rods[r])) continue;
    for (int o = r - 1; o >= 0; --o) {
      if (!in_body(model.rods[o], state.rods[o]) || !is_nested(model.nestings, o, r)) continue;
      if (can_hang(model, scratch, r, o)) scratch.lead[r] = scratch.lead[o], scratch.around[r] = o;
      break;
    }
    scratch.nests[scratch.lead[r]].members.push_back(r);
  }
}

/// Numbers the branches of a nest; returns how many there are.
int number_branches(const Model& model, const Nest& nest, Scratch& scratch) {
  const int fork = forks_at(model, nest, scratch);
  int count = 0;
  for (const int r : nest.members) {
    const int o = scratch.around[r];
    scratch.branch[r] = o < 0 ? 0 : o == fork ? ++count : scratch.branch[o];
  }
  return count;
}

/// The nest of what a branch has beyond the trunk; null: nothing.
Nest* beyond(const Model& model, const State& state, int branch, Nest& trunk, Scratch& scratch) {
  Nest* nest = nullptr;
  for (std::size_t k = 0; k < trunk.members.size(); ++k) {
    const int r = trunk.members[k];
    if (scratch.branch[r] != branch) continue;
    if (!nest) {
      if (scratch.exits[r].first == model.rods[r].elements) continue;
      nest = &scratch.nests[r];
      nest->trunk = &trunk;
      nest->fork_m = scratch.exits[r].depth_m;
    }
    if (state.rods[r].inserted_m <= nest->fork_m) continue;
    nest->beside[nest->members.size()] = static_cast<int>(k);
    nest->members.push_back(r);
  }
  return nest;
}

/// Finds the branches of a nest that have left its trunk, if they are enough for a fork.
void find_branches(const Model& model, const State& state, Nest& trunk, Scratch& scratch) {
  const int count = number_branches(model, trunk, scratch);
  find_exits(model, state, trunk, scratch);
  if (count < model.fork_from) return;
  for (int branch = 1; branch <= count; ++branch)
    if (Nest* nest = beyond(model, state, branch, trunk, scratch)) trunk.branches[trunk.branch_count++] = nest;
  if (trunk.branch_count >= model.fork_from) return;
  for (int b = 0; b < trunk.branch_count; ++b) {
    Nest& branch = *trunk.branches[b];
    branch.members.clear();
    branch.trunk = nullptr, branch.fork_m = 0;
  }
  trunk.branch_count = 0;
}

}  // namespace

void find_strands(const Model& model, const std::vector<char>& was_in_body, State& state, Scratch& scratch) {
  scratch.strands.clear();
  find_nests(model, state, scratch);
  for (int r = 0; r < static_cast<int>(model.rods.size()); ++r) {
    Nest& nest = scratch.nests[r];
    if (scratch.lead[r] != r || nest.members.empty()) continue;
    if (nest.members.size() == 1) {
      state.rods[r].exposed = state.rods[r].first;
      scratch.strands.push_back({r, &scratch.rods[r], &state.rods[r], &scratch.contacts[r], nullptr});
      continue;
    }
    const int next = nest.members[1];
    if (!was_in_body[r]) lay_over(scratch.rods[r].inside, model.rods[next], state.rods[next], state.rods[r]);
    find_branches(model, state, nest, scratch);
    scratch.strands.push_back({r, &nest.s, &nest.own, &nest.contact, &nest, nest.branch_count});
    for (int b = 0; b < nest.branch_count; ++b) {
      Nest& branch = *nest.branches[b];
      scratch.strands.push_back({branch.members.front(), &branch.s, &branch.own, &branch.contact, &branch});
    }
  }
}

}  // namespace ostium::core
