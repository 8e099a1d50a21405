#include "app/session/handling/catheter_errors.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostium {

namespace {

constexpr double led_m = 20e-3, naked_m = 10e-3;
constexpr double wound_rad = 1.5 * std::numbers::pi, wound_s = 1, whip_rad = std::numbers::pi;
constexpr double deep_s = 2, bad_trace_s = 5;
constexpr double astray_m = 20e-3, ventricle_s = 2, thick_in_coronary_m = 5e-3;
constexpr double degrees = 180 / std::numbers::pi;

}  // namespace

/// From the sheath to the arch alone: in the root a shaped guide moves without a wire.
void CatheterErrors::look_at_lead(const HandlingMap& map, const HandlingScene& x, const EventSink& say) {
  const HandledTool& own = x.tools[static_cast<std::size_t>(x.catheter)];
  const double advanced_m = std::max(0.0, own.inserted_m - inserted_m_);
  inserted_m_ = own.inserted_m;
  const int wire = x.thick_wire >= 0 ? x.thick_wire : x.thin_wire;
  const double leads_m = wire < 0 ? 0 : x.tools[static_cast<std::size_t>(wire)].inserted_m - own.inserted_m;
  naked_m_ = leads_m >= led_m || !map.before_root[static_cast<std::size_t>(own.sphere)] ? 0 : naked_m_ + advanced_m;
  if (naked_.begins(naked_m_ > naked_m, x.time_s)) say(EventCode::catheter_without_wire, x.catheter, 1e3 * leads_m);
}

void CatheterErrors::look_at_twist(const HandlingScene& x, const EventSink& say) {
  if (wound_.begins(wound_for_.seconds(std::fabs(x.twist_rad) > wound_rad, x.time_s) > wound_s, x.time_s))
    say(EventCode::wound_up, x.catheter, degrees * x.twist_rad);
  double& oldest = twists_[looks_ % twists_.size()];
  const double changed_rad = looks_ < twists_.size() ? 0 : std::fabs(x.twist_rad - oldest);
  oldest = x.twist_rad, ++looks_;
  if (whip_.begins(changed_rad > whip_rad, x.time_s)) say(EventCode::tip_whips, x.catheter, degrees * changed_rad);
}

void CatheterErrors::look_at_seat(const HandlingMap& map, const HandlingScene& x, Trace trace, const EventSink& say) {
  const auto cell = static_cast<std::size_t>(x.catheter_cell);
  const bool deep = x.catheter_cell >= 0 && map.from_ostium_m[cell] > map.deep_m[cell];
  if (deep_.begins(deep_for_.seconds(deep, x.time_s) > deep_s, x.time_s))
    say(EventCode::deep_seat, x.catheter, 1e3 * map.from_ostium_m[cell]);
  const bool bad = trace == Trace::damped || trace == Trace::ventricularised;
  if (bad_trace_.begins(bad_trace_for_.seconds(bad, x.time_s) > bad_trace_s, x.time_s))
    say(EventCode::bad_trace_kept, x.catheter, static_cast<double>(trace));
}

void CatheterErrors::look_at_thick_wire(const HandlingMap& map, const HandlingScene& x, const EventSink& say) {
  if (x.thick_wire < 0) return;
  const auto at = static_cast<std::size_t>(x.tools[static_cast<std::size_t>(x.thick_wire)].sphere);
  const double astray = map.astray_m[at], in_coronary = map.in_coronary_m[at];
  const bool in_ventricle = ventricle_for_.seconds(map.in_ventricle[at], x.time_s) > ventricle_s;
  if (astray_.begins(astray > astray_m, x.time_s)) say(EventCode::wire_strays, x.thick_wire, 1e3 * astray);
  if (in_ventricle_.begins(in_ventricle, x.time_s)) say(EventCode::wire_in_ventricle, x.thick_wire);
  if (in_coronary_.begins(in_coronary > thick_in_coronary_m, x.time_s))
    say(EventCode::thick_wire_in_coronary, x.thick_wire, 1e3 * in_coronary);
}

void CatheterErrors::look(const HandlingMap& map, const HandlingScene& x, Trace trace, const EventSink& say) {
  if (x.catheter != catheter_) catheter_ = x.catheter, naked_m_ = inserted_m_ = 0, looks_ = 0;
  if (x.catheter >= 0) {
    look_at_lead(map, x, say);
    look_at_twist(x, say);
    look_at_seat(map, x, trace, say);
  }
  look_at_thick_wire(map, x, say);
}

}  // namespace ostium
