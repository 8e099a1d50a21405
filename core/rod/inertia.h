#pragma once
/// Inertia, weight and drag of a rod over one step, and the integrator's history.
#include "core/model/inputs.h"
#include "core/model/rod.h"
#include "core/model/scratch.h"
#include "core/model/state.h"

namespace ostium::core {

/// For nodes begin to end - 1, the position without internal force and the compliance to it: writes scratch.target and
/// chain.compliance. `loss` holds their drag.
void predict_nodes(const Rod& rod, const Damping& loss, int begin, int end, const RodState& state,
                   const Eigen::Vector3d& gravity_W, double step_s, RodScratch& scratch);

/// Adds a dead load to a node; after predict_nodes.
void add_load(int node, const Eigen::Vector3d& force_W_N, RodScratch& scratch);

/// Extrapolates the frames' turn linearly (not when starting from rest): writes scratch.orientation, turn and force.
void predict_elements(const Rod& rod, const RodState& state, RodScratch& scratch);

/// Adds the elements' rotary inertia to chain.stiffness.
void add_rotary_inertia(const Rod& rod, double step_s, RodScratch& scratch);

/// Adds the torque of the elements' angular acceleration, from the last step's turn to the iterate's, to chain.torque;
/// after add_rotary_inertia.
void add_rotary_torque(const Rod& rod, const RodState& state, double step_s, RodScratch& scratch);

/// Copies the iterate into the state, with the matching velocities.
void commit(const Rod& rod, const RodScratch& scratch, double step_s, RodState& state);

/// Places the iterate's nodes along its frames, starting at the held end (the base before the tip).
void string_iterate(const Rod& rod, const RodState& state, RodScratch& scratch);

/// Copies the iterate's frames and nodes, and clears motion and forces.
void commit_at_rest(const Rod& rod, const RodScratch& scratch, RodState& state);

/// Copies the iterate's strains; none without material damping.
void take_strain(const Rod& rod, const RodScratch& scratch, RodState& state);

/// Rescales the history as if the last step had been `ratio` times as long, at constant motion.
void rescale_history(const Rod& rod, double ratio, RodState& state);

/// Keeps the shape and clears all motion.
void halt(const Rod& rod, RodState& state);

}  // namespace ostium::core
