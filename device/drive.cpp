#include "device/drive.h"

#include <algorithm>
#include <numbers>

#include "core/tunables.h"

namespace ostium {

namespace {

/// Takes from `pending` what a step can do of it; returns its rate.
double take(double& pending, double fastest, double step_s) {
  const double part = std::clamp(pending, -fastest * step_s, fastest * step_s);
  pending -= part;
  return part / step_s;
}

}  // namespace

void collect(const InstrumentMovement& movement, PendingDrive& pending) {
  pending.advance_m += 1e-3 * movement.advance_mm;
  pending.turn_rad += std::numbers::pi / 180 * movement.turn_deg;
}

void drive(const Eigen::Vector3d& axis_W, double step_s, PendingDrive& pending, RodInputs& inputs) {
  inputs.feed_m_s = take(pending.advance_m, tunables::max_drive_speed_m_s, step_s);
  inputs.base.hold = Hold::clamped;
  inputs.base.turn_rate_W_rad_s = take(pending.turn_rad, tunables::max_drive_turn_rad_s, step_s) * axis_W;
}

}  // namespace ostium
