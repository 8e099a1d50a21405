#pragma once
/// Collects hand movements, whatever their timing, and turns them into inputs for each step.
#include "core/model/inputs.h"
#include "device/host/strokes.h"

namespace ostium::device {

/// Movement of one instrument by the hand that no step has taken yet.
struct PendingDrive {
  double advance_m = 0, turn_rad = 0;
};

void collect(const InstrumentMovement& movement, PendingDrive& pending);

struct DriveRates {
  double feed_m_s = 0, turn_rad_s = 0;
};

/// The part of the pending movement that a step of `step_s` takes: with `smooth_s` = 0 all of it at once; otherwise as
/// a low pass with that time constant, so that single sensor counts cause no jerks. Movement faster than the simulation
/// allows (core/base/tolerances.h) stays pending, so that none is lost.
DriveRates take(double step_s, double smooth_s, PendingDrive& pending);

/// Takes it and sets a step's inputs: feed, and turning about `axis_W`, the direction of advance at the introducer
/// (unit vector).
void drive(const Eigen::Vector3d& axis_W, double step_s, PendingDrive& pending, core::RodInputs& inputs);

}  // namespace ostium::device
