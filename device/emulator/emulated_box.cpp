#include "device/emulator/emulated_box.h"

#include <algorithm>
#include <cmath>

namespace ostium::device {

namespace {

using Reply = std::optional<std::vector<std::uint8_t>>;
constexpr std::uint16_t firmware_version = 2;

/// Rounded, and wrapped like a 32-bit counter.
std::int32_t counter(double counts) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(std::llround(counts)));
}

std::int32_t less(std::int32_t a, std::int32_t b) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) - static_cast<std::uint32_t>(b));
}

std::int16_t sensor(double value, double gain, double offset) {
  return static_cast<std::int16_t>(std::clamp(std::round((value - offset) / gain), -32768.0, 32767.0));
}

}  // namespace

std::array<std::int32_t, 2> EmulatedBox::counts(std::size_t k) const {
  const TrackCalibration& t = calibration_.track[k];
  const double pushed_mm = station[k].advanced_mm + t.cross_talk_mm_deg * station[k].turned_deg;
  return {counter(pushed_mm / t.mm_per_count), counter(station[k].turned_deg / t.deg_per_count)};
}

InReport EmulatedBox::report() const {
  InReport r;
  r.armed = armed_, r.watchdog = watchdog_released_;
  r.emergency_stop = emergency_stop, r.over_temperature = over_temperature, r.calibrated = true;
  r.sequence = sequence_;
  r.time_us = static_cast<std::uint32_t>(time_us_);
  r.last_out_sequence = last_out_sequence_;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto now = counts(k);
    r.insertion[k] = less(now[0], zero_[k][0]), r.roll[k] = less(now[1], zero_[k][1]);
    r.quality[k] = station[k].quality, r.tool[k] = station[k].tool;
  }
  r.pressure = sensor(pressure_atm, calibration_.atm_per_count, calibration_.pressure_offset_atm);
  r.flow = sensor(flow_mL_s, calibration_.mL_s_per_count, calibration_.flow_offset_mL_s);
  r.pedals = pedals;
  const std::uint64_t age_ms = any_out_ ? (time_us_ - last_out_us_) / 1000 : 65535;
  r.age_of_last_out_ms = static_cast<std::uint16_t>(std::min<std::uint64_t>(age_ms, 65535));
  return r;
}

std::array<std::uint8_t, in_report_bytes> EmulatedBox::sample() {
  time_us_ += 1'000'000u / rate_Hz_;
  ++sequence_;
  if (emergency_stop || over_temperature) release();
  if (armed_ && time_us_ - last_out_us_ >= 1000u * watchdog_ms_) {
    release();
    watchdog_released_ = true;
    ++releases_;
  }
  return bytes_of(report());
}

void EmulatedBox::take(std::span<const std::uint8_t> bytes) {
  const auto out = parse_out_report(bytes);
  if (!out || (out->rotary && !separate_brakes)) {
    ++ignored_;
    return;
  }
  ++taken_;
  any_out_ = true;
  last_out_us_ = time_us_, last_out_sequence_ = out->sequence;
  if (!out->arm) {
    release();
    arm_was_low_ = true;
  } else if (arm_was_low_ && !emergency_stop && !over_temperature) {
    armed_ = true, watchdog_released_ = false, arm_was_low_ = false;
  }
  if (armed_) clamp_ = out->clamp, rotary_ = out->rotary.value_or(out->clamp);
}

void EmulatedBox::release() {
  clamp_ = rotary_ = {};
  armed_ = arm_was_low_ = false;
}

Reply EmulatedBox::control(std::uint8_t request, std::uint16_t value, std::span<const std::uint8_t> data) {
  Reply stall, done{std::in_place};
  const bool may_calibrate = value == calibration_key && !armed_;
  const auto answer = [](const auto& bytes) { return std::vector<std::uint8_t>(bytes.begin(), bytes.end()); };
  switch (static_cast<Request>(request)) {
    case Request::info:
      return answer(
          bytes_of(BoxInfo{device_protocol_version, 4, firmware_version, rate_Hz_, watchdog_ms_, separate_brakes}));
    case Request::read_calibration:
      return answer(bytes_of(calibration_));
    case Request::write_calibration:
      if (!may_calibrate || data.size() != calibration_bytes) return stall;
      written_calibration_.assign(data.begin(), data.end());
      return done;
    case Request::commit_calibration:
      if (!may_calibrate) return stall;
      try {
        calibration_ = parse_calibration(written_calibration_);
      } catch (const CalibrationError&) {
        return stall;
      }
      return done;
    case Request::zero:
      if (value > 15) return stall;
      for (std::size_t k = 0; k < 4; ++k)
        if (value >> k & 1) zero_[k] = counts(k);
      return done;
    case Request::watchdog_time:
      if (value < 10 || value > 500) return stall;
      watchdog_ms_ = value;
      return done;
    case Request::rate:
      if (value != 125 && value != 250 && value != 500 && value != 1000) return stall;
      rate_Hz_ = value;
      return done;
    case Request::statistics:
      return answer(bytes_of(BoxStatistics{sequence_, taken_, ignored_, releases_}));
  }
  return stall;
}

}  // namespace ostium::device
