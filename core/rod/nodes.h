#pragma once
/// Nodes of a rod in the step's linear system, at target + P (internal force); used by everything that holds nodes.
#include "core/model/scratch.h"
#include "core/model/state.h"

namespace ostium::core {

/// Internal force on node i: that of its distal element minus that of its proximal one.
inline V3<double> node_force(const Field<3>& force, int first, int elements, int i) {
  V3<double> f{};
  if (i < elements) f = load3<double>(force, i);
  if (i > first) f = f - load3<double>(force, i - 1);
  return f;
}

/// Position of node i in the last solution, m.
inline V3<double> solved_position(const RodScratch& s, int i) {
  const BlockTridiagonal& chain = s.chain;
  V3<double> force = node_force(chain.force, chain.first, chain.elements, i);
  if (i == chain.elements) force = force + chain.pull;
  return load3<double>(s.target, i) + load6<double>(chain.compliance, i) * force;
}

/// Turn of an element about its d3 in the iterate, rad.
double spin(const RodScratch& s, int element);
/// Turn of the rod about its axis at node i in the iterate, rad: the mean of its two elements.
double spin_of_node(const RodScratch& s, int i);

/// Moves a node's position without internal force, and updates the chain's gaps.
void move_target(int i, const V3<double>& move, RodScratch& s);

/// Nodes extrapolated at their present motion: used to look for contacts and bores.
void guess_nodes(const RodState& state, RodScratch& s);

/// After a first contact with force along n, removes the impact from the node's history: second-order differences would
/// otherwise throw it back at half its impact speed. After the commit.
void land(int i, const V3<double>& n, double step_s, RodState& state);

}  // namespace ostium::core
