#include "device/emulator/stroking_hand.h"

#include <algorithm>
#include <cmath>

namespace ostium::device {

/// In: to the end of the travel (which pauses the simulation), back, still; the last stroke stops short of the end.
/// Out: the reverse, so that tool and instrument end where they began.
StrokingHand::Move StrokingHand::move_of(int n, double station_mm) const {
  constexpr double still_s = 0.5;
  const int pauses = strokes - 1, in = 2 * pauses + 1, out = 2 * pauses;
  n %= in + out + 1;
  if (n == in + out) return {-station_mm, 1, true};
  if (n == in - 1) return {290, still_s};
  if (n < in) return n % 2 == 0 ? Move{299, 0} : Move{100, still_s};
  return (n - in) % 2 == 0 ? Move{1, 0} : Move{200.3, still_s};
}

void StrokingHand::move(EmulatedBox& box) {
  const double station_mm = box.calibration().track[1].before_introducer_mm;
  const double now_s = box.time_s();
  if (!begun_) tip_mm_ = -station_mm, last_s_ = now_s, begun_ = true;
  const double elapsed_s = now_s - last_s_;
  last_s_ = now_s;
  const Move to = move_of(next_, station_mm);
  const double way_mm = std::clamp(to.to_mm - tip_mm_, -2 * mm_s * elapsed_s, mm_s * elapsed_s);
  EmulatedTool& wire = box.station[1];
  wire.advanced_mm += way_mm;
  tip_mm_ += way_mm;
  if (way_mm > 0) wire.turned_deg += deg_s * elapsed_s;
  const bool there = std::abs(to.to_mm - tip_mm_) < 1e-9;
  box.station[0] = {Tool::guide, 200, box.station[0].advanced_mm, 0};
  const bool nothing = there && to.outside;
  wire.tool = nothing ? Tool::none : Tool::wire, wire.quality = nothing ? std::uint8_t{0} : std::uint8_t{180};
  if (!there) arrived_s_ = -1;
  if (there && arrived_s_ < 0) arrived_s_ = now_s;
  if (there && now_s - arrived_s_ >= to.still_s) ++next_, arrived_s_ = -1;
}

}  // namespace ostium::device
