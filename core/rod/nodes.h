#pragma once
/// Nodes of a rod in the step's linear system, for what holds them: they are at target + P (internal force).
#include "core/model/scratch.h"
#include "core/model/state.h"

namespace ostium::core {

/// Internal force on node i: that of its distal element less that of its proximal one.
inline V3<double> node_force(const Field<3>& force, int first, int elements, int i) {
  V3<double> f{};
  if (i < elements) f = load3<double>(force, i);
  if (i > first) f = f - load3<double>(force, i - 1);
  return f;
}

/// Where the last solve has it, m.
inline V3<double> solved_position(const RodScratch& s, int i) {
  const BlockTridiagonal& chain = s.chain;
  return load3<double>(s.target, i) +
         load6<double>(chain.compliance, i) * node_force(chain.force, chain.first, chain.elements, i);
}

/// How far an element has turned about its d3 in the iterate, rad.
double spin(const RodScratch& s, int element);
/// How far node i has turned about the rod in the iterate, rad: the mean of its two elements.
double spin_of_node(const RodScratch& s, int i);

/// Moves where node i would go without internal force, and keeps the chain's gaps in step.
void move_target(int i, const V3<double>& move, RodScratch& s);

/// Nodes as if they went on as they moved: the guess that contacts and bores are looked for with.
void guess_nodes(const RodState& state, RodScratch& s);

/// A node that has just met something solid, and is pushed along n, goes on as it moved in this step: second-order
/// differences would throw it back at half the speed that it came with. After commit.
void land(int i, const V3<double>& n, double step_s, RodState& state);

}  // namespace ostium::core
