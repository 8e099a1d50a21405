#include "device/stroking_hand.h"

#include <algorithm>

namespace ostium {

void StrokingHand::move(EmulatedBox& box) {
  constexpr double still_s = 0.5, rest_s = 1, drawn_back_mm = 100;
  const double now_s = box.time_s(), elapsed_s = now_s - last_s_, for_s = now_s - since_s_;
  last_s_ = now_s;
  const double end_mm = 305 + box.calibration().track[1].before_introducer_mm;  // beyond what the box follows
  const double least_mm = does_ == Does::draws_back ? drawn_back_mm : 0;
  const double way = does_ == Does::pushes ? 1 : does_ == Does::draws_back || does_ == Does::goes_out ? -2 : 0;
  const double to_mm = std::clamp(depth_mm_ + way * mm_s * elapsed_s, least_mm, end_mm);
  EmulatedTool& wire = box.station[1];
  wire.advanced_mm += to_mm - depth_mm_;
  if (does_ == Does::pushes) wire.turned_deg += deg_s * elapsed_s;
  depth_mm_ = to_mm;
  box.station[0] = {Tool::guide, 200, box.station[0].advanced_mm, 0};
  wire.tool = does_ == Does::rests ? Tool::none : Tool::wire;
  wire.quality = does_ == Does::rests ? std::uint8_t{0} : std::uint8_t{180};
  switch (does_) {
    case Does::pushes:
      if (depth_mm_ >= end_mm) next(++done_ < strokes ? Does::draws_back : Does::goes_out, now_s);
      break;
    case Does::draws_back:
      if (depth_mm_ <= drawn_back_mm) next(Does::holds, now_s);
      break;
    case Does::holds:
      if (for_s > still_s) next(Does::pushes, now_s);
      break;
    case Does::goes_out:
      if (depth_mm_ <= 0) next(Does::rests, now_s), done_ = 0;
      break;
    case Does::rests:
      if (for_s > rest_s) next(Does::pushes, now_s);
      break;
  }
}

}  // namespace ostium
