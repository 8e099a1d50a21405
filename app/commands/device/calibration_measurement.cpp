#include "app/commands/device/calibration_measurement.h"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include "app/commands/device/device.h"
#include "data/formats/load_error.h"

namespace ostium::app {

namespace {

/// Throws LoadError where nobody can press it any more.
bool enter_pressed() {
  pollfd in{STDIN_FILENO, POLLIN, 0};
  if (::poll(&in, 1, 0) <= 0) return false;
  char some[256];
  if (::read(STDIN_FILENO, some, sizeof some) > 0) return true;
  throw data::LoadError("the input ended before Enter was pressed; nothing was written into the box");
}

}  // namespace

Measurement::Measurement(const std::string& serial) : port_(serial) {
  for (const double until = clock_s() + 2; clock_s() < until && reports_ == 0;) state_ = port_.poll(0.02, *this);
  if (reports_ > 0) return;
  device::BoxSnapshot now;
  now.trouble = state_.trouble;
  now.link = state_.open ? device::Link::silent : device::Link::unplugged;
  throw data::LoadError(std::string(advice(now)));
}

void Measurement::wait(const std::string& what, double seconds) {
  if (seconds <= 0) fmt::print(stderr, "{}, then press Enter\n", what);
  for (const double until = clock_s() + seconds; seconds > 0 ? clock_s() < until : !enter_pressed();)
    if (!port_.poll(0.02, *this).open) throw data::LoadError("the box was unplugged while it was measured");
}

double Measurement::mean(double sum) const {
  if (samples_ == 0) throw data::LoadError("nothing was measured; press Enter a second later, or more");
  return sum / samples_;
}

void Measurement::came(std::span<const std::uint8_t> bytes) {
  const auto report = device::parse_in_report(bytes);
  if (!report) return;
  const auto difference = [](auto now, auto before) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(now) - static_cast<std::uint32_t>(before));
  };
  if (reports_++ > 0) {
    for (std::size_t k = 0; k < 4; ++k) {
      insertion_[k] += difference(report->insertion[k], last_.insertion[k]);
      roll_[k] += difference(report->roll[k], last_.roll[k]);
    }
    elapsed_s_ += 1e-6 * difference(report->time_us, last_.time_us);
  }
  pressure_ += report->pressure, flow_ += report->flow, samples_ += 1;
  last_ = *report;
}

}  // namespace ostium::app
