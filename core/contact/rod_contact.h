#pragma once
/// Contact of rods with each other where neither runs in the other, and with themselves. Off unless Model::rods_touch.
///
/// Where two pieces of rods come near, their closest points are kept apart along the line between them. Strands are
/// solved one by one, so each is held by a spring to where the other was last seen, beside the force that they had come
/// to (augmented Lagrangian, Jacobi's order). The force is then the mean of what both felt, and they are solved anew,
/// until both feel the same and neither is in the other. A spring is about as stiff as the nodes' inertia, so each
/// moves by less than the gap: that settles, if slowly where stiff rods are pressed. Without friction.
///
/// Rods that meet at more than their radii in one step pass through each other: 0.36 m/s for two wires of 0.36 mm.
#include "core/model/model.h"
#include "core/model/report.h"
#include "core/model/scratch.h"
#include "core/model/state.h"

namespace ostium::core {

/// Finds them, from the strands' guesses; after find_walls.
void find_rod_contacts(const Model& model, Scratch& scratch);

/// Ties a strand's nodes to what is known of the others: changes scratch.target and chain.compliance. Before
/// tie_to_walls.
void tie_to_rods(const Strand& strand, Scratch& scratch);

/// After all strands are solved: what they felt. True if they are to be solved again.
bool renew_rod_contacts(Scratch& scratch);

/// Moves forces into the strands' states, and adds them to the report; after the commit.
void commit_rod_contacts(Scratch& scratch, std::vector<RodTouch>& touches);

}  // namespace ostium::core
