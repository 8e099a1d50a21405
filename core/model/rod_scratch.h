#pragma once
/// Working memory of one chain during a step.
#include "core/model/inputs.h"
#include "core/model/rod.h"
#include "core/model/rod_state.h"
#include "core/solver/block_tridiagonal.h"

namespace ostium::core {

/// How acceleration follows from positions; see inertia.cpp.
enum class TimeScheme {
  bdf2,       ///< second-order backward differences: normal steps
  fresh,      ///< constant acceleration: first step after an end was held or released
  from_rest,  ///< backward Euler without initial velocity: fallback for a step without another solution
};

/// Whether the stiffness includes the geometric stiffness of internal forces and moments. Without it, Newton's method
/// converges only linearly, but its matrix is positive definite for any load.
enum class GeometricStiffness { with, without };

/// Newton status of a rod: iterating, converged, close enough when iterations ran out, no finite solution, not in the
/// body.
enum class Progress { open, done, given_up, failed, absent };

struct RodScratch {
  Rod inside;        ///< the part of the rod that is inside its introducer
  RodInputs inputs;  ///< of this step, limited
  TimeScheme scheme = TimeScheme::bdf2;
  double step_s = 0;  ///< of this attempt; shorter than the model's when retried from rest
  Progress progress = Progress::open;
  double defect = 0;       ///< residual of inextensibility in the iterate
  double last_defect = 0;  ///< ... in the one before
  GeometricStiffness geometric = GeometricStiffness::with;
  BlockTridiagonal chain;  ///< the linear system and its solution
  Field<3> target;         ///< m, (#nodes): where a node would go without internal force
  Field<4> orientation;    ///< (#elements): the iterate
  Field<3> turn;           ///< rad, (#elements): turn of the iterate since the beginning of the step
  Field<3> force;          ///< N, (#elements): the iterate
  Field<3> position;       ///< m, (#nodes): the iterate
  Field<3> strain;         ///< 1/m, (#joints): the iterate; only with material damping
};

/// Sets sizes for `elements` and `rolls`; strains only if damped.
void resize(RodScratch& scratch, int elements, int rolls, bool damped);

}  // namespace ostium::core
