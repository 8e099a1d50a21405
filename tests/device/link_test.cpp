#include "device/host/link.h"

#include <gtest/gtest.h>

#include "device/emulator/emulated_box.h"

namespace ostium::device {
namespace {

TEST(Link, SaysWhatIsWrongAndComesBack) {
  EmulatedBox box{Calibration{}};
  LinkState s;
  EXPECT_EQ(link(s), Link::unplugged);
  plugged_in(s);
  EXPECT_EQ(link(s), Link::silent);
  EXPECT_TRUE(received(box.sample(), s));
  EXPECT_EQ(link(s), Link::running);
  EXPECT_EQ(advice(link(s)), "");
  time_passed(0.09, s);
  EXPECT_EQ(link(s), Link::running);
  time_passed(0.02, s);
  EXPECT_EQ(link(s), Link::silent);
  received(box.sample(), s);
  box.emergency_stop = true;
  received(box.sample(), s);
  EXPECT_EQ(link(s), Link::stopped);
  box.emergency_stop = false;
  received(box.sample(), s);
  EXPECT_EQ(link(s), Link::running);
  unplugged(s);
  EXPECT_EQ(link(s), Link::unplugged);
  plugged_in(s);
  EXPECT_EQ(link(s), Link::silent);
  received(box.sample(), s);
  EXPECT_EQ(link(s), Link::running);
  EXPECT_EQ(s.taken, 5u);
}

TEST(Link, AnotherVersionIsNotSilence) {
  EmulatedBox box{Calibration{}};
  LinkState s;
  plugged_in(s);
  auto bytes = box.sample();
  bytes[1] = 2;
  EXPECT_FALSE(received(bytes, s));
  EXPECT_EQ(link(s), Link::wrong_version);
  EXPECT_EQ(s.ignored, 1u);
  received(box.sample(), s);
  EXPECT_EQ(link(s), Link::running);
}

}  // namespace
}  // namespace ostium::device
