#pragma once
/// Inertia, weight and drag of a rod over one step, and what its integrator remembers.
#include "core/model/inputs.h"
#include "core/model/rod.h"
#include "core/model/scratch.h"
#include "core/model/state.h"

namespace ostium::core {

/// Where nodes begin to end - 1 would go without internal force, and how they yield to it: writes scratch.target and
/// chain.compliance. `loss` is their drag.
void predict_nodes(const Rod& rod, const Damping& loss, int begin, int end, const RodState& state,
                   const Eigen::Vector3d& gravity_W, double step_s, RodScratch& scratch);

/// A dead load on a node, after predict_nodes.
void add_load(int node, const Eigen::Vector3d& force_W_N, RodScratch& scratch);

/// Extrapolates the frames' turn linearly (not at all from rest): writes scratch.orientation, turn and force.
void predict_elements(const Rod& rod, const RodState& state, RodScratch& scratch);

/// Adds the elements' rotary inertia to chain.stiffness.
void add_rotary_inertia(const Rod& rod, double step_s, RodScratch& scratch);

/// Adds the torque of the elements' angular acceleration, from the last step's turn to the iterate's, to chain.torque;
/// after add_rotary_inertia.
void add_rotary_torque(const Rod& rod, const RodState& state, double step_s, RodScratch& scratch);

/// Moves the iterate into the state, with the velocities that belong to it.
void commit(const Rod& rod, const RodScratch& scratch, double step_s, RodState& state);

/// Strings the iterate's nodes along its frames, from the end that is held (the base before the tip).
void string_iterate(const Rod& rod, const RodState& state, RodScratch& scratch);

/// Takes over the iterate's frames and nodes, and forgets motion and forces.
void commit_at_rest(const Rod& rod, const RodScratch& scratch, RodState& state);

/// Takes over the iterate's strains; without material damping there are none.
void take_strain(const Rod& rod, const RodScratch& scratch, RodState& state);

/// The last step as if it had been `ratio` times as long, and the rod had moved as evenly.
void rescale_history(const Rod& rod, double ratio, RodState& state);

/// Keeps the shape and forgets all motion.
void halt(const Rod& rod, RodState& state);

}  // namespace ostium::core
