#include "device/host/drive.h"

#include <gtest/gtest.h>

#include "core/base/tolerances.h"
#include "core/base/units.h"

namespace ostium::device {
namespace {

/// However the timing of hand and steps differs, the hand's whole movement is fed, within the simulation's speed limit.
TEST(Drive, NothingOfTheHandIsLost) {
  const Eigen::Vector3d axis_W(0, 0.6, 0.8);
  PendingDrive pending;
  core::RodInputs inputs;
  double fed_m = 0, turned_rad = 0;
  const double step_s = 1e-3;
  for (int i = 0; i < 400; ++i) {
    for (int k = 0; k < i % 3 && i < 300; ++k) collect({i == 100 ? 30.0 : 0.3, -4.5}, pending);
    drive(axis_W, step_s, pending, inputs);
    ASSERT_LE(std::abs(inputs.feed_m_s), core::tolerances::max_drive_speed_m_s);
    ASSERT_LE(inputs.base.turn_rate_W_rad_s.norm(), core::tolerances::max_drive_turn_rad_s + 1e-9);
    fed_m += inputs.feed_m_s * step_s;
    turned_rad += inputs.base.turn_rate_W_rad_s.dot(axis_W) * step_s;
  }
  EXPECT_NEAR(fed_m, 1e-3 * (299 * 0.3 + 30), 1e-12);
  EXPECT_NEAR(turned_rad, -300 * 4.5 * units::pi / 180, 1e-9);
  EXPECT_EQ(inputs.feed_m_s, 0);
}

}  // namespace
}  // namespace ostium::device
