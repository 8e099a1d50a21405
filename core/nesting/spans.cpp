/// Where rods of a nest leave each other, and the elements of the chain.
#include <algorithm>
#include <cmath>

#include "core/base/tolerances.h"
#include "core/math/alignment.h"
#include "core/math/rotation.h"
#include "core/nesting/nest.h"
#include "core/rod/introducer.h"

namespace ostium::core {

namespace {

// Share of an element at which it leaves the surrounding rod, and at which it returns; different, so that a trembling
// hand does not switch elements back and forth.
constexpr double leaves_at = 0.6, returns_at = 0.4;

double norm(const V3<double>& v) { return std::sqrt(dot(v, v)); }

/// Turns element j of a rod so that its tangent lies along `chord`.
void swing(const V3<double>& chord, int j, RodState& s) {
  const Q4<double> q = load4<double>(s.orientation, j);
  const Eigen::Quaterniond onto = rotation_between(to_eigen(director3(q)), to_eigen(chord));
  store4(s.orientation, j, from_eigen((onto * to_eigen(q)).normalized()));
}

/// The first element of a rod that protrudes by `length_m` from those around it; N: none does enough.
int first_exposed(const Rod& rod, const RodState& s, double length_m) {
  const int N = rod.elements;
  const auto own = [&](int i) { return rod.length.at(0)[i]; };
  const auto beyond = [&](int i) { return length_m - rod.node_from_tip_m[i + 1]; };
  int j = s.exposed;
  if (j >= N) {
    if (length_m < leaves_at * own(N - 1)) return N;
    j = N - 1;
  }
  while (j > s.first && beyond(j) > own(j) + leaves_at * own(j - 1)) --j;
  while (j < N && beyond(j) < returns_at * own(j)) ++j;
  return j;
}

/// Starts the protruding part at `root`; frames follow for elements that have left or returned. True if that part is
/// to be moved there: rods that were laid out independently, or part faster than that.
bool expose(const Rod& rod, int first, double length_m, const V3<double>& root, RodState& s) {
  const int before = s.exposed, N = rod.elements;
  s.exposed = first;
  if (first == N) return false;
  const V3<double> chord = load3<double>(s.position, first + 1) - root;
  if (std::fabs(norm(chord) - length_m) > tolerances::torn_part * rod.length.at(0)[first]) return true;
  if (first == before) return false;
  swing(chord, first, s);
  for (int j = first + 1; j <= before && j < N; ++j)
    swing(load3<double>(s.position, j + 1) - load3<double>(s.position, j), j, s);
  return false;
}

void set_joint_lengths(Rod& rod) {
  for (int i = 0; i <= rod.elements; ++i) {
    const double behind = i > 0 ? rod.length.at(0)[i - 1] / 2 : 0,
                 ahead = i < rod.elements ? rod.length.at(0)[i] / 2 : 0;
    rod.joint_length.at(0)[i] = behind + ahead;
  }
}

}  // namespace

void lay_over(const Rod& inside, const Rod& inner, const RodState& along, RodState& s) {
  int j = along.first;
  double depth = 0, length = along.inserted_m - inner.node_from_tip_m[j + 1];
  for (int i = inside.first; i <= inside.elements; ++i) {
    const double at = i == inside.first ? 0 : inside.total_length_m - inside.node_from_tip_m[i];
    while (j + 1 < inner.elements && at > depth + length) depth += length, ++j, length = inner.length.at(0)[j];
    const double part = (at - depth) / length;
    const auto mix = [&](const Field<3>& f) {
      return madd(part, load3<double>(f, j + 1) - load3<double>(f, j), load3<double>(f, j));
    };
    store3(s.position, i, mix(along.position));
    store3(s.position_before, i, mix(along.position_before));
    store3(s.velocity, i, mix(along.velocity));
    store3(s.velocity_before, i, mix(along.velocity_before));
  }
  for (int i = inside.first; i < inside.elements; ++i)
    swing(load3<double>(s.position, i + 1) - load3<double>(s.position, i), i, s);
}

void find_exits(const Model& model, const State& state, const Nest& nest, Scratch& scratch) {
  Exit last[1 + max_branches];  // along the trunk and along each branch; depth_m 0: it has none yet
  for (const int r : nest.members) {
    const RodState& own = state.rods[r];
    Exit& reached = last[scratch.branch[r]];
    if (r == nest.members.front()) {
      scratch.exits[r] = {own.first, 0, r, false};
      reached = {0, scratch.rods[r].inside.total_length_m, r, false};
      continue;
    }
    if (reached.depth_m == 0) reached = last[0];
    const int first = first_exposed(model.rods[r], own, own.inserted_m - reached.depth_m);
    scratch.exits[r] = {first, reached.depth_m, reached.from, false};
    if (first < model.rods[r].elements) reached = {0, own.inserted_m, r, false};
  }
}

void lay_spans(const Model& model, Scratch& scratch, State& state, Nest& nest) {
  nest.spans.clear();
  Rod& chain = nest.s.inside;
  double reach = 0;
  int at = 0;
  for (std::size_t k = 0; k < nest.members.size(); ++k) {
    const int r = nest.members[k];
    const bool at_introducer = k == 0 && !nest.trunk;
    const Rod& rod = at_introducer ? scratch.rods[r].inside : model.rods[r];
    RodState& own = state.rods[r];
    Exit& exit = scratch.exits[r];
    Layer& layer = nest.layers[k];
    layer.fed_m = scratch.fed_m[r];
    layer.rod = r, layer.roll = static_cast<int>(k) - 1, layer.inserted_m = own.inserted_m;
    layer.covered = at;
    const double protrudes = own.inserted_m - exit.depth_m;
    if (at_introducer) {
      own.exposed = own.first;
      layer.inserted_m = rod.total_length_m;
    } else if (!nest.trunk) {
      const V3<double> tip = load3<double>(state.rods[exit.from].position, model.rods[exit.from].elements);
      exit.torn = expose(rod, exit.first,
                         exit.first < rod.elements ? protrudes - rod.node_from_tip_m[exit.first + 1] : 0, tip, own);
    }
    const int first = own.exposed, count = rod.elements - first;
    const bool in_branch = nest.branch_count > 0 && scratch.branch[r] > 0;
    layer.end = at + count;
    if (count == 0 || in_branch) {
      layer.end = 0;
      continue;
    }
    nest.spans.push_back({r, first, at, count, exit.torn});
    copy_entries(rod.length, first, rod.elements, chain.length, at);
    if (!at_introducer) chain.length.at(0)[at] = protrudes - rod.node_from_tip_m[first + 1];
    double depth = exit.depth_m;
    for (int e = at; e < at + count; ++e) {
      nest.depth.at(0)[e] = depth;
      depth += chain.length.at(0)[e];
    }
    nest.depth.at(0)[at + count] = reach = layer.inserted_m;
    at += count;
  }
  chain.first = 0, chain.elements = at;
  chain.total_length_m = reach - nest.fork_m;
  nest.layer_count = static_cast<int>(nest.members.size());
  set_joint_lengths(chain);
  if (!nest.trunk) return;
  const Rod& trunk = nest.trunk->s.inside;
  nest.behind_m = trunk.length.at(0)[trunk.elements - 1];
  chain.joint_length.at(0)[0] += nest.behind_m / 2;
}

}  // namespace ostium::core
