#pragma once
/// Friction at walls; for contact alone.
#include "core/model/scratch.h"
#include "core/model/state.h"

namespace ostium::core {

/// Prepares the friction of node i, from the force that pressed it in the last step and how it is expected to slide.
void find_rubbing(const RodState& own, int i, const NodeWalls& walls, const RodScratch& s, ContactScratch& c);

/// Ties the node, r = target + P (internal force), by it.
void rub(int i, const ContactScratch& c, const RodScratch& s, S3<double>& P, V3<double>& target);

/// Force on node i in the iterate, N.
V3<double> rubbing_force(int i, const RodScratch& s, const ContactScratch& c);

/// Keeps the slip.
void take_rubbing(int i, const RodScratch& s, const ContactScratch& c, RodState& own);

}  // namespace ostium::core
