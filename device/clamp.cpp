#include "device/clamp.h"

#include <algorithm>
#include <cmath>

namespace ostium {

namespace {

void follow(Direction& d, double moved, double reversal) {
  d.position += moved;
  const double since = d.position - d.turned_at;
  if (d.sign * since > 0) d.turned_at = d.position;  // the farthest it got
  if (std::abs(d.position - d.turned_at) <= reversal) return;
  d.sign = since > 0 ? 1 : -1;
  d.turned_at = d.position;
}

double resisted(int sign, double load) { return std::isfinite(load) ? std::max(0.0, sign * load) : 0.0; }

double wanted_N(const ClampSettings& s, const ClampLoad& load, const ClampState& state, std::size_t i) {
  const double along_N = resisted(state.along[i].sign, load.push_N);
  const double around_N = resisted(state.around[i].sign, load.torque_Nm) / s.radius_m[i];
  return std::min(s.most_N, std::hypot(along_N, around_N));
}

}  // namespace

void advance_clamps(const ClampSettings& s, const ClampRequest& request, const Movements& m, ClampState& state) {
  const bool open = request.paused || !(request.load_age_s <= s.stale_s);
  for (std::size_t i = 0; i < tools; ++i) {
    if (!m.tool[i].seen) {
      state.along[i] = state.around[i] = {};
      state.level_N[i] = 0;
      continue;
    }
    follow(state.along[i], m.tool[i].advance_mm, s.reversal_mm);
    follow(state.around[i], m.tool[i].turn_deg, s.reversal_deg);
    const double wanted = open ? 0 : wanted_N(s, request.load[i], state, i);
    double& level = state.level_N[i];
    state.moving[i] |= wanted == 0 || std::abs(wanted - level) > s.least_felt * std::max(wanted, level);
    if (!state.moving[i]) continue;
    level = std::clamp(wanted, level - s.fall_N_s * m.elapsed_s, level + s.rise_N_s * m.elapsed_s);
    state.moving[i] = level != wanted;
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
  for (std::size_t k = 0; k < 4; ++k) {
    if (report.tool[k] == Tool::none || !out.arm) continue;
    const double share = state.level_N[index_of(report.tool[k])] / calibration.clamp_full_scale_N[k];
    out.clamp[k] = static_cast<std::uint16_t>(std::lround(65535 * std::clamp(share, 0.0, 1.0)));
  }
  return out;
}

}  // namespace ostium
