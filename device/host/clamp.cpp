#include "device/host/clamp.h"

#include <algorithm>
#include <cmath>

namespace ostium::device {

namespace {

void follow(Direction& d, double moved, double reversal) {
  d.position += moved;
  const double since = d.position - d.turned_at;
  if (d.sign * since > 0) d.turned_at = d.position;  // the farthest position so far
  if (std::abs(d.position - d.turned_at) <= reversal) return;
  d.sign = since > 0 ? 1 : -1;
  d.turned_at = d.position;
}

double resisted(int sign, double load) { return std::isfinite(load) ? std::max(0.0, sign * load) : 0.0; }

double hold(const ClampSettings& s, double load, double least, double elapsed_s, HeldLoad& l) {
  if (load == 0) return l = {}, 0;  // the load now helps the hand's movement
  l.smooth += (s.smooth_s > 0 ? 1 - std::exp(-elapsed_s / s.smooth_s) : 1) * (load - l.smooth);
  if (std::abs(l.smooth - l.followed_at) > std::max(least, s.least_felt * std::max(l.smooth, l.followed_at)))
    l.followed_at = l.smooth, l.follow_for_s = s.settle_s;
  if (l.follow_for_s <= 0) return l.held;
  l.follow_for_s -= elapsed_s;
  if (l.follow_for_s <= 0) l.followed_at = l.smooth;
  return l.held = l.smooth;
}

/// What pushing and turning are to be held with, N at the tool's surface.
struct Held {
  double along_N = 0, around_N = 0;
};

Held wanted(const ClampSettings& s, const ClampLoad& load, double elapsed_s, ClampState& state, std::size_t i) {
  const double along_N =
      hold(s, resisted(state.along[i].sign, load.push_N), s.least_push_N, elapsed_s, state.push_N[i]);
  const double around_Nm =
      hold(s, resisted(state.around[i].sign, load.torque_Nm), s.least_torque_Nm, elapsed_s, state.torque_Nm[i]);
  return {along_N, around_Nm / s.radius_m[i]};
}

void approach(const ClampSettings& s, double wanted_N, double elapsed_s, double& level_N) {
  level_N =
      std::clamp(std::min(s.most_N, wanted_N), level_N - s.fall_N_s * elapsed_s, level_N + s.rise_N_s * elapsed_s);
}

std::uint16_t level_of(double N, double full_scale_N) {
  return static_cast<std::uint16_t>(std::lround(65535 * std::clamp(N / full_scale_N, 0.0, 1.0)));
}

}  // namespace

void advance_clamps(const ClampSettings& s, const ClampRequest& request, const Movements& m, ClampState& state) {
  const bool open = request.paused || !(request.load_age_s <= s.stale_s);
  for (std::size_t i = 0; i < tools; ++i) {
    if (!m.tool[i].seen) {
      state.along[i] = state.around[i] = {};
      state.push_N[i] = state.torque_Nm[i] = {};
      state.level_N[i] = state.rotary_N[i] = 0;
      continue;
    }
    follow(state.along[i], m.tool[i].advance_mm, s.reversal_mm);
    follow(state.around[i], m.tool[i].turn_deg, s.reversal_deg);
    const Held held = wanted(s, open ? ClampLoad{} : request.load[i], m.elapsed_s, state, i);
    const bool apart = request.separate_brakes;
    approach(s, apart ? held.along_N : std::hypot(held.along_N, held.around_N), m.elapsed_s, state.level_N[i]);
    approach(s, apart ? held.around_N : 0, m.elapsed_s, state.rotary_N[i]);
  }
}

OutReport clamp_report(const ClampRequest& request, const Calibration& calibration, const InReport& report,
                       ClampState& state) {
  if (!request.arm)
    state.stopped = false;
  else if (report.emergency_stop || report.over_temperature)
    state.stopped = true;
  const auto taken_since = static_cast<std::int16_t>(report.last_out_sequence - state.arm_sequence);
  const bool refused = state.arm && taken_since >= 0 && !report.armed;

  OutReport out;
  out.sequence = ++state.sequence;
  out.arm = request.arm && !state.stopped && !refused;
  if (out.arm && !state.arm) state.arm_sequence = out.sequence;
  state.arm = out.arm;
  if (request.separate_brakes) out.rotary.emplace();
  for (std::size_t k = 0; k < 4; ++k) {
    if (report.tool[k] == Tool::none || !out.arm) continue;
    const std::size_t tool = index_of(report.tool[k]);
    const double full_scale_N = calibration.clamp_full_scale_N[k];
    out.clamp[k] = level_of(state.level_N[tool], full_scale_N);
    if (out.rotary) (*out.rotary)[k] = level_of(state.rotary_N[tool], full_scale_N);
  }
  return out;
}

}  // namespace ostium::device
