#pragma once
/// Loads and ties on a stretch of a rod between its ends. After predict_nodes, before walls.
///
/// `begin` to `end` - 1 are the chain's nodes that belong to the rod: in a nest, those where it is the outermost. The
/// last of them is the rod's tip.
#include "core/model/inputs.h"
#include "core/model/rod.h"
#include "core/model/scratch.h"

namespace ostium::core {

/// Spreads a load evenly over the nodes of its stretch.
void add_stretch_load(const Rod& rod, const StretchLoad& load, int begin, int end, RodScratch& scratch);

/// Ties the node nearest to a tether's position. `own`: the chain's state.
void tie_to_tether(const Rod& rod, const Tether& tether, int begin, int end, const RodState& own, RodScratch& scratch);

}  // namespace ostium::core
