#pragma once
/// Friction at walls. Internal to contact.
#include "core/model/scratch.h"
#include "core/model/state.h"

namespace ostium::core {

/// Prepares the friction of node i from its contact force in the last step and its expected sliding.
void find_rubbing(const RodState& own, int i, const NodeWalls& walls, const RodScratch& s, ContactScratch& c);

/// Ties node i, r = target + P (internal force), by the friction spring.
void rub(int i, const ContactScratch& c, const RodScratch& s, S3<double>& P, V3<double>& target);

/// Friction force on node i in the iterate, N.
V3<double> rubbing_force(int i, const RodScratch& s, const ContactScratch& c);

/// Stores the slip in the state.
void take_rubbing(int i, const RodScratch& s, const ContactScratch& c, RodState& own);

}  // namespace ostium::core
