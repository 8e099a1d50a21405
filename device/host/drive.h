#pragma once
/// The last piece of the way from a hand to `Inputs`: movements of any clock, collected, and handed out per step.
#include "core/model/inputs.h"
#include "device/host/strokes.h"

namespace ostium::device {

/// What the hand has moved and no step has taken yet, of one instrument.
struct PendingDrive {
  double advance_m = 0, turn_rad = 0;
};

void collect(const InstrumentMovement& movement, PendingDrive& pending);

struct DriveRates {
  double feed_m_s = 0, turn_rad_s = 0;
};

/// What a step of `step_s` does of what is pending: with `smooth_s` = 0 all of it at once; else it follows as a low
/// pass of that time constant, so that single counts of a sensor are no jerks. What is faster than the engine allows
/// (core/tunables.h) stays pending, so that nothing of the hand's movement is lost.
DriveRates take(double step_s, double smooth_s, PendingDrive& pending);

/// The same, all at once, into a step's inputs: feed along and turning about `axis_W`, the direction of advance at the
/// introducer (unit length).
void drive(const Eigen::Vector3d& axis_W, double step_s, PendingDrive& pending, core::RodInputs& inputs);

}  // namespace ostium::device
