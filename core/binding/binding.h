#pragma once
/// The binding of nested instruments: an inner rod stays within the bore of its outer one, and both feel it.
///
/// Rods are solved in turn, the outer one first, and again until each takes for the other's force what it is:
/// - the outer rod as if what is inside it went along with it (lending.cpp): it is lent the inner rods' mass, bending
///   stiffness, moment and force, and, beyond its tip, the inner rod itself. All of this is counted from where the
///   inner rods were in the last step, so at rest nothing is left of it but the force that they exert;
/// - each inner rod within the outer one's new shape (bore.cpp): where a node would leave the bore it is tied to the
///   wall, a stiff spring towards the lumen's curved centreline; an active set, settled within the solve. At the tip of
///   the outer rod it is held at the rim, which lies between two of its nodes;
/// - then what ties and rims exert is compared with what the outer rod was moved by (balance.cpp).
///
/// Mostly once is enough while hands move; a quick release takes several turns. Friction is in slide.cpp.
#include "core/model.h"
#include "core/scratch.h"
#include "core/state.h"

namespace ostium {

/// Whether both rods of a nesting are in the body.
bool is_bound(const Nesting& nesting, const Scratch& scratch);

/// Before walls are found: holds the nodes of rod `r` that are in bores, so that no wall does.
void hold_enclosed(const Model& model, std::size_t r, Scratch& scratch);

/// Lets rod `r` feel what is inside it: changes its scratch.target and chain.compliance, and prepares lend_*.
void feel_inner_rods(const Model& model, const State& state, std::size_t r, Scratch& scratch);

/// Adds the inner rods' internal force to the iterate's, so that it turns with rod `r`.
void lend_to_force(const State& state, std::size_t r, Scratch& scratch);
/// The rod's own internal force in the iterate; wants chain.joint_moment to be its own. `force` may be s.force.
void own_force(const Rod& rod, const BindingScratch& binding, const RodScratch& s, Field<3>& force);
/// Adds to joints and elements what the inner rods lend; after linearise_joints and assemble_elements.
void lend_to_joints(const BindingScratch& binding, RodScratch& s);
void lend_to_elements(const BindingScratch& binding, RodScratch& s);
/// What rod `r`'s chain stands for: the rod inside its introducer, and what protrudes from its tip.
const Rod& solved_rod(const Scratch& scratch, std::size_t r);

/// Finds, from the outer rods' iterates, in which bore each node of rod `r` is and which nodes are pressed against it.
void find_bores(const Model& model, const State& state, std::size_t r, Scratch& scratch);

/// Prepares the friction of these nodes, from how the iterates slide.
void find_slides(const Model& model, const State& state, std::size_t r, Scratch& scratch);
/// Lets it follow the outer rods' new iterates; how stiff it is stays.
void move_slides(const Model& model, const State& state, std::size_t r, Scratch& scratch);
/// Adds to rod `r`'s equations what its bores turn it with; and what the rods inside it drag node i by along it, and
/// turn it with. After linearise_joints and assemble_elements.
void turn_with_bore(std::size_t r, Scratch& scratch);
V3<double> drag_on_node(const RodState& outer, const Rod& inside, int i);
void take_drag(const RodState& outer, RodScratch& s);
/// Moves slips and drags into the state.
void commit_slides(const Model& model, const Scratch& scratch, State& state);

/// Ties these nodes to their bores: changes scratch.target and chain.compliance of rod `r`.
void tie_to_bores(std::size_t r, Scratch& scratch);

/// After a solve: lets nodes go that their tie pulls, and ties those that left their bore. True if there are any: then
/// the chain, which is adapted, is to be solved again.
bool change_ties(std::size_t r, Scratch& scratch);

/// Whether rod `r` can be in others.
bool is_inner(const Scratch& scratch, std::size_t r);

/// How many rims rod `r` may have to be held at.
int rim_count(const Scratch& scratch, std::size_t r);
/// A unit force on the rod at rim `k`, as a further load of the rod's chain.
ChainLoad& rim_load(std::size_t r, int k, Scratch& scratch);
/// Adds to the chain's solution what the rims take, once all rim_loads are solved.
void take_rim_loads(std::size_t r, Scratch& scratch);

/// Before a step, and before it is tried again.
void forget_corrections(BindingScratch& binding);
/// Measures what the ties and rims of the iterate exert.
void measure_binding(const Model& model, Scratch& scratch);
/// Compares that with what rod `r` was moved by, and corrects its targets if they differ: then solve it again.
bool balance(std::size_t r, double step_s, const RodState& state, Scratch& scratch);

/// Lets the bores of rod `r` follow the outer rods' new iterates; ties stay.
void move_bores(const Model& model, std::size_t r, Scratch& scratch);

/// Moves the forces between nested rods into the state; after all commits.
void commit_binding(const Model& model, const Scratch& scratch, State& state);
/// Makes nested rods go on from rest, without the forces between them: after a step that they could not follow.
void calm_nests(const Model& model, const Scratch& scratch, State& state);

}  // namespace ostium
