#include "device/host/drive.h"

#include <algorithm>
#include <cmath>

#include "core/base/tolerances.h"
#include "core/base/units.h"

namespace ostium::device {

namespace {

/// Takes from `pending` what one step can do, and returns it as a rate. A remainder below `least` is taken whole.
double take(double& pending, double share, double least, double fastest, double step_s) {
  const double wanted = std::abs(pending) < least ? pending : share * pending;
  const double part = std::clamp(wanted, -fastest * step_s, fastest * step_s);
  pending -= part;
  return part / step_s;
}

}  // namespace

void collect(const InstrumentMovement& movement, PendingDrive& pending) {
  pending.advance_m += 1e-3 * movement.advance_mm;
  pending.turn_rad += units::pi / 180 * movement.turn_deg;
}

DriveRates take(double step_s, double smooth_s, PendingDrive& pending) {
  constexpr double least_m = 1e-8, least_rad = 1e-6;
  const double share = smooth_s > 0 ? 1 - std::exp(-step_s / smooth_s) : 1;
  return {take(pending.advance_m, share, least_m, core::tolerances::max_drive_speed_m_s, step_s),
          take(pending.turn_rad, share, least_rad, core::tolerances::max_drive_turn_rad_s, step_s)};
}

void drive(const Eigen::Vector3d& axis_W, double step_s, PendingDrive& pending, core::RodInputs& inputs) {
  const DriveRates rates = take(step_s, 0, pending);
  inputs.feed_m_s = rates.feed_m_s;
  inputs.base.hold = core::Hold::clamped;
  inputs.base.turn_rate_W_rad_s = rates.turn_rad_s * axis_W;
}

}  // namespace ostium::device
