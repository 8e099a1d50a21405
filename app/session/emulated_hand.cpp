#include "app/session/emulated_hand.h"

#include <algorithm>
#include <numbers>

namespace ostium {

namespace {

constexpr double draw_back_m_s = 0.25, drawn_back_m = 0.03;  // how far in a tool is left for the next stroke

}  // namespace

void EmulatedHand::ask(const std::vector<Tool>& held, const std::vector<ToolInputs>& tools, const CArmInputs& c_arm) {
  held_ = held;
  wish_ = tools;
  c_arm_ = c_arm;
}

void EmulatedHand::see(const BoxSnapshot& now) {
  if (now.pause != Pause::none && pause_ == Pause::none) ++drawn_back_;
  pause_ = now.pause, paused_by_ = now.paused_by;
  if (paused_by_ != Tool::none) in_box_m_ = now.tool[index_of(paused_by_)].in_box_m;
}

void EmulatedHand::move(EmulatedBox& box) {
  const double elapsed_s = box.time_s() - last_s_;
  last_s_ = box.time_s();
  std::size_t track = 0;
  for (std::size_t t = 0; t < held_.size(); ++t) {
    if (held_[t] == Tool::none || track >= box.station.size()) continue;
    EmulatedTool& tool = box.station[track++];
    tool.tool = held_[t], tool.quality = 200;
    if (pause_ == Pause::none) {
      tool.advanced_mm += 1e3 * wish_[t].advance_m_s * elapsed_s;
      tool.turned_deg += 180 / std::numbers::pi * wish_[t].turn_rad_s * elapsed_s;
    } else if (held_[t] == paused_by_) {
      const double to_m = pause_ == Pause::travel_full ? drawn_back_m : 0.27, step_m = draw_back_m_s * elapsed_s;
      tool.advanced_mm += 1e3 * std::clamp(to_m - in_box_m_, -step_m, step_m);
    }
  }
  box.pedals = static_cast<std::uint16_t>((c_arm_.fluoroscopy > 0) | (c_arm_.cine > 0) << 1);
}

}  // namespace ostium
