#include "device/emulated_port.h"

#include <algorithm>
#include <utility>

namespace ostium {

EmulatedPort::EmulatedPort(EmulatedBox& box, std::function<void(EmulatedBox&)> hand, int delay)
    : box_(box), hand_(std::move(hand)), delay_(delay), identity_{box.calibration().serial, "Emulated box", "here"} {}

PortState EmulatedPort::poll(double, ReportSink& sink) {
  if (plugged != state_.open) {
    state_.open = plugged;
    if (plugged) {
      ++state_.openings;
      return state_;  // it is asked before it streams
    }
    box_.release();
    underway_.clear();
    ++counts_.departures;
  }
  while (!underway_.empty() && underway_.front().samples_left <= 0) {
    box_.take(underway_.front().bytes);
    underway_.pop_front();
    ++counts_.out;
  }
  for (Underway& u : underway_) --u.samples_left;
  if (hand_) hand_(box_);
  const auto bytes = box_.sample();
  if (!state_.open) return state_;
  ++counts_.in;
  sink.came(bytes);
  return state_;
}

void EmulatedPort::send(std::span<const std::uint8_t> bytes) {
  if (!state_.open || bytes.size() != out_report_bytes) return;
  Underway& u = underway_.emplace_back();
  u.samples_left = delay_ - 1;
  std::copy(bytes.begin(), bytes.end(), u.bytes.begin());
}

std::optional<std::size_t> EmulatedPort::read(std::uint8_t request, std::span<std::uint8_t> into) {
  if (!state_.open) return {};
  const auto reply = box_.control(request, 0);
  if (!reply || reply->size() > into.size()) return {};
  std::copy(reply->begin(), reply->end(), into.begin());
  return reply->size();
}

bool EmulatedPort::write(std::uint8_t request, std::uint16_t value, std::span<const std::uint8_t> data) {
  return state_.open && box_.control(request, value, data).has_value();
}

}  // namespace ostium
