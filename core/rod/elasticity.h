#pragma once
/// Elasticity of a rod, linearised about the current iterate.
#include "core/model/rod.h"
#include "core/model/scratch.h"
#include "core/model/state.h"

namespace ostium::core {

/// Whether the end frames are joined to their holds.
struct EndJoints {
  bool base = false, tip = false;
};

/// Moments and stiffness of all joints: writes chain.joint_stiffness and chain.joint_moment (world frame) and, with
/// material damping, scratch.strain. Ends without a joint get zeros. `step_s` = 0: no damping (statics).
void linearise_joints(const Rod& rod, const RodState& state, EndJoints ends, double step_s, RodScratch& scratch);

/// The same for the joints at the two ends only.
void linearise_end_joints(const Rod& rod, const RodState& state, EndJoints ends, double step_s, RodScratch& scratch);

/// Largest angle of an inner joint in the iterate. At pi a joint would flip to the other side: elements are too long
/// for their bending or twist.
double largest_joint_angle(const Rod& rod, const RodScratch& scratch);

/// Assembles the elements' rows from their joints: writes chain.arm, stiffness, torque (without inertia) and gap.
void assemble_elements(const Rod& rod, RodScratch& scratch);

}  // namespace ostium::core
