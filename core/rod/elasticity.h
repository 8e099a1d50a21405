#pragma once
/// Elasticity of a rod, linearised about the current iterate.
#include "core/model/rod.h"
#include "core/model/scratch.h"
#include "core/model/state.h"

namespace ostium::core {

/// Whether the frame of an end is joined to what holds it.
struct EndJoints {
  bool base = false, tip = false;
};

/// Moments and stiffness of all joints: writes chain.joint_stiffness and chain.joint_moment (world frame) and, with
/// material damping, scratch.strain. Ends without a joint get zeros. `step_s` = 0: no damping (statics).
void linearise_joints(const Rod& rod, const RodState& state, EndJoints ends, double step_s, RodScratch& scratch);

/// The same for the joints at the two ends alone.
void linearise_end_joints(const Rod& rod, const RodState& state, EndJoints ends, double step_s, RodScratch& scratch);

/// Largest angle of an inner joint of the iterate. At pi, a joint would take the shorter way back: elements are too
/// long for the bending or twist that they are to carry.
double largest_joint_angle(const Rod& rod, const RodScratch& scratch);

/// Gathers the elements' rows from their joints: writes chain.arm, stiffness, torque (without inertia) and gap.
void assemble_elements(const Rod& rod, RodScratch& scratch);

}  // namespace ostium::core
