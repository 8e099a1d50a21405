#include "app/session/device/emulated_box_driver.h"

#include <algorithm>

#include "core/base/units.h"

namespace ostium::app {

namespace {

constexpr double draw_back_m_s = 0.25, drawn_back_m = 0.03;  // depth left for the next stroke
constexpr double away_s = 0.1;  // time without a tool in an exchange, and again until the next is tracked

}  // namespace

void EmulatedBoxDriver::ask(const std::vector<device::Tool>& held, const SessionInputs& inputs) {
  if (held_ != held) held_ = held, turns_ = turns_at_the_box(held);
  wish_ = inputs;
}

void EmulatedBoxDriver::see(const device::BoxSnapshot& now) {
  if (now.pause != device::Pause::none && pause_ == device::Pause::none) ++drawn_back_;
  pause_ = now.pause, paused_by_ = now.paused_by;
  if (paused_by_ != device::Tool::none) in_box_m_ = now.tool[index_of(paused_by_)].in_box_m;
}

/// If the script moves another instrument than the one in the box, exchanges them: the old one is removed, the station
/// is empty for a moment, the next one appears.
void EmulatedBoxDriver::exchange(double elapsed_s) {
  for (std::size_t t = 0; t < held_.size(); ++t) {
    const bool moves = wish_.tools[t].feed_m_s != 0 || wish_.tools[t].turn_rad_s != 0;
    Station& station = stations_[index_of(held_[t])];
    station.count = turns_[t].count;
    if (moves && turns_[t].place != station.place && station.changing_s < 0) station.changing_s = 0;
  }
  for (Station& station : stations_) {
    if (station.changing_s < 0) continue;
    station.changing_s += elapsed_s;
    if (station.changing_s >= 2 * away_s) station.place = (station.place + 1) % station.count, station.changing_s = -1;
  }
}

void EmulatedBoxDriver::move(device::EmulatedBox& box) {
  const double elapsed_s = box.time_s() - last_s_;
  last_s_ = box.time_s();
  if (pause_ == device::Pause::none) exchange(elapsed_s);
  for (std::size_t t = 0; t < held_.size(); ++t) {
    const std::size_t i = index_of(held_[t]);
    const Station& station = stations_[i];
    if (turns_[t].place != station.place) continue;
    device::EmulatedTool& tool = box.station[i];
    const bool changing = station.changing_s >= 0, away = changing && station.changing_s < away_s;
    tool.tool = away ? device::Tool::none : held_[t], tool.quality = away ? std::uint8_t{0} : std::uint8_t{200};
    if (changing) continue;
    if (pause_ == device::Pause::none) {
      tool.advanced_mm += 1e3 * wish_.tools[t].feed_m_s * elapsed_s;
      tool.turned_deg += 180 / units::pi * wish_.tools[t].turn_rad_s * elapsed_s;
    } else if (held_[t] == paused_by_) {
      const double to_m = pause_ == device::Pause::travel_full ? drawn_back_m : 0.27,
                   step_m = draw_back_m_s * elapsed_s;
      tool.advanced_mm += 1e3 * std::clamp(to_m - in_box_m_, -step_m, step_m);
    }
  }
  box.pedals = static_cast<std::uint16_t>(int{wish_.c_arm.fluoroscopy} | int{wish_.c_arm.cine} << 1);
  box.pressure_atm = wish_.delivery.gauge_Pa / 101'325;
  box.flow_mL_s = 1e6 * (wish_.delivery.injection_m3_s - wish_.delivery.aspiration_m3_s);
}

}  // namespace ostium::app
