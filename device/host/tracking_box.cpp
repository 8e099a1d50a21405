#include "device/host/tracking_box.h"

#include "core/base/units.h"

namespace ostium::device {

namespace {

constexpr double Pa_per_atm = 101'325, m3_per_mL = 1e-6, rad_per_deg = units::pi / 180;

}  // namespace

TrackingBox::TrackingBox(Port& port, const TrackingBoxSettings& settings)
    : port_(port), settings_(settings), polled_s_(port.now_s()) {}

/// A box was plugged in, for the first time or again: reads its identity and calibration. Instruments stay where they
/// are.
void TrackingBox::begin() {
  unplugged(link_);
  plugged_in(link_);
  tracking_ = {};
  const std::uint16_t out_sequence = clamp_.sequence;
  clamp_ = {};
  clamp_.sequence = out_sequence;
  sent_ = {};
  info_ = read_info(port_).value_or(BoxInfo{});
  wanted_.separate_brakes = info_.separate_brakes;
  link_.wrong_version = info_.version != 0 && info_.version != device_protocol_version;
  try {
    calibration_ = parse_calibration(read_calibration(port_));
    calibration_problem_.clear();
  } catch (const CalibrationError& error) {
    calibration_ = {};
    calibration_problem_ = error.what();
  }
  now_.calibrated = calibration_problem_.empty();
}

void TrackingBox::poll(double wait_s, const BoxRequest& request) {
  zero_what_is_asked(request);
  if (request.step_s != request_.step_s) load_came_s_ = port_.now_s();
  request_ = request;
  wanted_.arm = request.arm && settings_.clamps && now_.calibrated;
  wanted_.load = request.load;
  wanted_.load_age_s = port_.now_s() - load_came_s_;
  some_came_ = false;
  const PortState state = port_.poll(wait_s, *this);
  const double now_s = port_.now_s();
  if (state.openings != now_.openings) {
    now_.openings = state.openings;
    begin();
    polled_s_ = port_.now_s();  // the requests took time in which reports could not be received
  } else {
    if (!some_came_) time_passed(now_s - polled_s_, link_);
    polled_s_ = now_s;
  }
  if (!state.open && link_.plugged) {
    unplugged(link_);
    tracking_ = {};
    clamp_.level_N = clamp_.rotary_N = {};
  }
  now_.trouble = state.trouble;
  if (some_came_) answer();
  publish();
}

void TrackingBox::zero_what_is_asked(const BoxRequest& request) {
  for (std::size_t i = 0; i < tools; ++i)
    if (request.zeroings[i] != zeroings_[i]) {
      zeroings_[i] = request.zeroings[i];
      zero(hands_, static_cast<Tool>(i + 1));
    }
}

void TrackingBox::came(std::span<const std::uint8_t> bytes) {
  const auto report = received(bytes, link_);
  if (!report) return;
  some_came_ = true;
  report_ = *report;
  const Movements m = movements(calibration_, report_, tracking_);
  const auto moved = follow(settings_.hands, m, hands_);
  wanted_.paused = hands_.pause != Pause::none;
  advance_clamps(settings_.clamp, wanted_, m, clamp_);
  now_.lost += m.lost_reports;
  now_.box_s += m.elapsed_s;
  for (std::size_t i = 0; i < tools; ++i) {
    now_.tool[i].fed_m += 1e-3 * moved[i].advance_mm;
    now_.tool[i].turned_rad += rad_per_deg * moved[i].turn_deg;
  }
  note_round_trip(report_);
}

void TrackingBox::note_round_trip(const InReport& report) {
  if (report.last_out_sequence == acknowledged_) return;
  acknowledged_ = report.last_out_sequence;
  Sent& sent = sent_[acknowledged_ % sent_.size()];
  if (sent.sequence != acknowledged_ || sent.at_s < 0) return;
  now_.round_trip = {now_.round_trip.count + 1, port_.now_s() - sent.at_s};
  sent.at_s = -1;
}

void TrackingBox::answer() {
  OutReport out = clamp_report(wanted_, calibration_, report_, clamp_);
  out.identify = request_.identify;
  sent_[out.sequence % sent_.size()] = {out.sequence, port_.now_s()};
  if (out.rotary)
    port_.send(brake_bytes_of(out));
  else
    port_.send(bytes_of(out));
}

void TrackingBox::publish() {
  now_.link = link(link_);
  now_.reports = link_.taken, now_.ignored = link_.ignored;
  now_.port = port_.counts();
  now_.armed = link_.plugged && report_.armed, now_.watchdog = report_.watchdog;
  now_.pause = hands_.pause, now_.paused_by = hands_.paused_by, now_.picture = hands_.picture;
  const bool running = now_.link == Link::running;
  now_.pressure_Pa = running ? Pa_per_atm * pressure_atm(calibration_, report_.pressure) : now_.pressure_Pa;
  now_.flow_m3_s = running ? m3_per_mL * flow_mL_s(calibration_, report_.flow) : 0;
  now_.pedals = running ? report_.pedals : std::uint16_t{0};
  now_.sequence = report_.sequence, now_.overruns = report_.overruns;
  for (std::size_t i = 0; i < tools; ++i) {
    ToolSnapshot& tool = now_.tool[i];
    const StrokeTool& hand = hands_.tool[i];
    tool.sight = hand.sight, tool.arrivals = hand.arrivals;
    tool.in_box_m = 1e-3 * hand.in_box_mm, tool.inserted_m = 1e-3 * hand.inserted_mm;
    tool.clamp_N = clamp_.level_N[i];
    tool.brake_Nm = settings_.clamp.radius_m[i] * clamp_.rotary_N[i];
    tool.quality = 0;
    for (std::size_t k = 0; k < 4; ++k)
      if (report_.tool[k] == static_cast<Tool>(i + 1)) tool.quality = std::max(tool.quality, report_.quality[k]);
  }
}

std::string_view advice(const BoxSnapshot& now) {
  switch (now.trouble) {
    case PortTrouble::none:
      break;
    case PortTrouble::no_access:
      return "The tracking box may not be opened by this user. Install the udev rule (device/README.md), plug it in "
             "again.";
    case PortTrouble::in_use:
      return "Another program has the tracking box. End it: this one goes on by itself.";
    case PortTrouble::not_a_box:
      return "A device with the tracking box's number does not have its endpoints. Update its firmware.";
    case PortTrouble::stalled:
      return "The tracking box refuses to send (stall). Unplug it and plug it in again.";
    case PortTrouble::failing:
      return "Transfers to the tracking box fail. Look at cable and hub; it is tried again and again.";
  }
  if (now.link != Link::running) return advice(now.link);
  for (const ToolSnapshot& tool : now.tool)
    if (tool.sight == ToolPresence::lost)
      return "A tool is in the patient, and its sensor does not see it: it stands still. Clean it, or push it on.";
  if (now.pause == Pause::travel_full)
    return "The travel is at its end. Draw back by half of it and hold still: the instruments stay where they are.";
  if (now.pause == Pause::travel_empty)
    return "The travel is at its beginning. Push in by half of it and hold still: the instruments stay where they are.";
  return now.calibrated ? "" : "The tracking box has no valid calibration: lengths are nominal, clamps stay open.";
}

}  // namespace ostium::device
