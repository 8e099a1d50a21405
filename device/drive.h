#pragma once
/// The last piece of the way from a hand to `Inputs`: movements of any clock, collected, and handed out per step.
#include "core/inputs.h"
#include "device/hands.h"

namespace ostium {

/// What the hand has moved and no step has taken yet, of one instrument.
struct PendingDrive {
  double advance_m = 0, turn_rad = 0;
};

void collect(const InstrumentMovement& movement, PendingDrive& pending);

/// Puts what is pending into a step's inputs: feed along and turning about `axis_W`, the direction of advance at the
/// introducer (unit length). What is faster than the engine allows (core/tunables.h) stays pending, so that nothing of
/// the hand's movement is lost.
void drive(const Eigen::Vector3d& axis_W, double step_s, PendingDrive& pending, RodInputs& inputs);

}  // namespace ostium
