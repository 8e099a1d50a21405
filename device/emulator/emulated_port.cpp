#include "device/emulator/emulated_port.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace ostium::device {

EmulatedPort::EmulatedPort(EmulatedBox& box, std::function<void(EmulatedBox&)> hand, int delay)
    : box_(box), hand_(std::move(hand)), delay_(delay), identity_{box.calibration().serial, "Emulated box", "here"} {
  assert(delay >= 1 && delay < longest_delay);
}

PortState EmulatedPort::poll(double, ReportSink& sink) {
  if (plugged != state_.open) {
    state_.open = plugged;
    if (plugged) {
      ++state_.openings;
      return state_;  // the caller reads it before it streams
    }
    box_.release();
    underway_ = {};
    ++counts_.departures;
  }
  Underway& due = underway_[++samples_ % underway_.size()];
  if (due.at == samples_) box_.take(std::span(due.bytes).first(due.count)), ++counts_.out;
  if (hand_) hand_(box_);
  const auto bytes = box_.sample();
  if (!state_.open) return state_;
  ++counts_.in;
  sink.came(bytes);
  return state_;
}

void EmulatedPort::send(std::span<const std::uint8_t> bytes) {
  if (!state_.open || bytes.size() > brake_report_bytes) return;
  const std::uint64_t at = samples_ + static_cast<std::uint64_t>(delay_);
  Underway& u = underway_[at % underway_.size()];
  u.at = at;
  u.count = bytes.size();
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

}  // namespace ostium::device
