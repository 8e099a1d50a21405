#include "device/host/tracking.h"

namespace ostium::device {

namespace {

/// b - a for wrapping counters.
std::int32_t difference(std::uint32_t a, std::uint32_t b) { return static_cast<std::int32_t>(b - a); }

double counted(std::int32_t before, std::int32_t now) {
  return difference(static_cast<std::uint32_t>(before), static_cast<std::uint32_t>(now));
}

bool seen_well(const InReport& report, std::size_t k, const TrackMemory& before) {
  const bool followed = before.tool != Tool::none && before.tool == report.tool[k];
  return report.tool[k] != Tool::none && report.quality[k] >= (followed ? lost_below_quality : found_from_quality);
}

/// Evaluates sequence number and clock.
Movements since(const InReport& report, const TrackingState& state) {
  Movements m;
  const std::int32_t steps = difference(state.sequence, report.sequence);
  m.restarted = !state.begun || steps < 0;
  if (m.restarted) return m;
  m.repeated = steps == 0;
  if (m.repeated) return m;
  m.lost_reports = static_cast<std::uint32_t>(steps - 1);
  m.elapsed_s = 1e-6 * (report.time_us - state.time_us);
  return m;
}

}  // namespace

Movements movements(const Calibration& calibration, const InReport& report, TrackingState& state) {
  Movements m = since(report, state);
  if (m.restarted) state.track = {};
  std::array<int, tools> best{-1, -1, -1, -1};
  for (std::size_t k = 0; k < 4; ++k) {
    TrackMemory& memory = state.track[k];
    const TrackMemory before = memory;
    if (!seen_well(report, k, before)) {
      memory = {};
      continue;
    }
    memory = {report.tool[k], report.insertion[k], report.roll[k]};
    const std::size_t i = index_of(report.tool[k]);
    if (report.quality[k] <= best[i]) continue;
    best[i] = report.quality[k];
    ToolMovement& tool = m.tool[i];
    tool = {true, 0, 0, calibration.track[k].before_introducer_mm};
    if (before.tool != memory.tool || m.repeated) continue;
    const double insertion = counted(before.insertion, memory.insertion), roll = counted(before.roll, memory.roll);
    tool.advance_mm = insertion_mm(calibration.track[k], insertion, roll);
    tool.turn_deg = roll_deg(calibration.track[k], roll);
  }
  state.begun = true;
  state.sequence = report.sequence, state.time_us = report.time_us;
  return m;
}

}  // namespace ostium::device
