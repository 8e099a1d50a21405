#pragma once
/// Friction at walls; for contact alone.
#include "core/scratch.h"
#include "core/state.h"

namespace ostium {

/// Prepares the friction of node i, from the force that pressed it in the last step and how it is expected to slide.
void find_rubbing(const RodState& own, int i, const NodeWalls& walls, const RodScratch& s, ContactScratch& c);

/// Ties the node, r = target + P (internal force), by it.
void rub(int i, const ContactScratch& c, const RodScratch& s, S3<double>& P, V3<double>& target);

/// Keeps the slip, and returns the force on the node, N.
V3<double> take_rubbing(int i, const RodScratch& s, const ContactScratch& c, RodState& own);

}  // namespace ostium
