#pragma once
/// Which walls a node can reach; for contact alone.
#include "core/model/scratch.h"
#include "core/model/state.h"

namespace ostium::core {

/// The first and the last node that walls may hold.
inline int first_free(const RodScratch& s) { return s.inside.first + (s.inputs.base.hold == Hold::free ? 0 : 1); }
inline int last_free(const RodScratch& s) { return s.inside.elements - (s.inputs.tip.hold == Hold::free ? 0 : 1); }

/// Looks again from `to`, m, at walls whose rim node i would be in the way of there: as it goes past a triangle, the
/// point of it that is nearest goes along, and what seemed to stand in its way lies beneath it.
void look_again(const Model& model, const Strand& strand, int i, const V3<double>& to, Scratch& scratch);

/// Follows node i on its way through the step to `to`, m: walls that it left the lumen through, or meets at the end,
/// are added to c.walls as active planes. True if there are any.
bool follow(const Model& model, const RodState& own, int i, const V3<double>& to, Scratch& scratch, RodScratch& s,
            ContactScratch& c);

/// How much deeper than by the planes that hold it node i is in the triangles at `at`, at the end of the step, m.
double deeper_than_planes(const Model& model, const RodState& own, int i, const V3<double>& at, Scratch& scratch,
                          const RodScratch& s, ContactScratch& c);

}  // namespace ostium::core
