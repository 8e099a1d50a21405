#pragma once
/// Finds the walls that a node can reach. Internal to contact.
#include "core/model/scratch.h"
#include "core/model/state.h"

namespace ostium::core {

/// The first and the last node that walls may act on.
inline int first_free(const RodScratch& s) { return s.inside.first + (s.inputs.base.hold == Hold::free ? 0 : 1); }
inline int last_free(const RodScratch& s) { return s.inside.elements - (s.inputs.tip.hold == Hold::free ? 0 : 1); }

/// The nodes whose ties are being settled.
struct NodeRange {
  int first, last;
};
inline NodeRange settling_nodes(const RodScratch& s, const ContactScratch& c) {
  if (c.window_first < 0) return {first_free(s), last_free(s)};
  return {c.window_first, c.window_last};
}

/// Recomputes, from `to` (m), the planes of triangle rims that node i would be behind there. The nearest point of a
/// triangle moves along as the node passes, so a rim that seemed to block the node may lie beneath it. True if an
/// active plane was removed: of two that hold the node from opposite sides, one may be a rim that an earlier solution
/// had seen from its other side.
bool look_again(const Model& model, const Strand& strand, int i, const V3<double>& to, Scratch& scratch);

/// Continuous collision: sweeps node i through the step to `to`, m. Walls through which it left the lumen, or which it
/// meets at the end, are added to c.walls as active planes. True if there are any.
bool follow(const Model& model, const RodState& own, int i, const V3<double>& to, Scratch& scratch, RodScratch& s,
            ContactScratch& c);

/// The walls that node i meets at `at`, m, or on its way there; those that it is behind are active.
NodeWalls walls_at(const Model& model, const RodState& own, int i, const V3<double>& at, Scratch& scratch,
                   const RodScratch& s, ContactScratch& c);

/// By how much node i at `at` is deeper in the triangles, at the end of the step, than in the planes that hold it, m.
double deeper_than_planes(const Model& model, const RodState& own, int i, const V3<double>& at, Scratch& scratch,
                          const RodScratch& s, ContactScratch& c);

}  // namespace ostium::core
