#pragma once
/// Working memory of one chain in a step.
#include "core/model/inputs.h"
#include "core/model/rod.h"
#include "core/model/rod_state.h"
#include "core/solver/block_tridiagonal.h"

namespace ostium::core {

/// How a step's acceleration follows from its positions; see inertia.cpp.
enum class TimeScheme {
  bdf2,       ///< second-order backward differences: every ordinary step
  fresh,      ///< constant acceleration: the first step after an end was held or let go
  from_rest,  ///< backward Euler without velocity: a step that has no other solution
};

/// Whether the stiffness includes that of the internal forces and moments. Without it Newton's method converges
/// linearly, but its matrix is positive definite whatever the rod is pushed or twisted with.
enum class GeometricStiffness { with, without };

/// Of a rod's iterations in a step: going on, converged, near enough when they ran out, without a finite solution; the
/// rod is not in the body.
enum class Progress { open, done, given_up, failed, absent };

struct RodScratch {
  Rod inside;        ///< the part of the rod that is inside its introducer
  RodInputs inputs;  ///< of this step, within limits
  TimeScheme scheme = TimeScheme::bdf2;
  double step_s = 0;  ///< of this try; less than the model's where a rod comes to rest
  Progress progress = Progress::open;
  double defect = 0;  ///< what the iterate leaves of inextensibility
  GeometricStiffness geometric = GeometricStiffness::with;
  BlockTridiagonal chain;  ///< the linear system and its solution
  Field<3> target;         ///< m, (#nodes): where a node would go if the rod exerted no force on it
  Field<4> orientation;    ///< (#elements): the iterate
  Field<3> turn;           ///< rad, (#elements): the iterate's turn since the beginning of the step
  Field<3> force;          ///< N, (#elements): the iterate
  Field<3> position;       ///< m, (#nodes): the iterate
  Field<3> strain;         ///< 1/m, (#joints): the iterate, with material damping only
};

/// Sizes for `elements`, with so many rolls; strains only if it is damped.
void resize(RodScratch& scratch, int elements, int rolls, bool damped);

}  // namespace ostium::core
