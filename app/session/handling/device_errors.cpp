#include "app/session/handling/device_errors.h"

#include <algorithm>
#include <cmath>

#include "app/session/outcome.h"

namespace ostium {

namespace {

constexpr double dragged_m = 2e-3, longest_s = 60, after_shift_s = 20, shift_mV = 0.2;
constexpr double beyond_m = 2e-3, beyond_atm = 10;

/// How far a balloon that lies in a lesion's stents stands out of them; 0: there is none, or it does not.
double beyond_stent_m(const SessionModel& model, const SessionState& state, int balloon) {
  const auto& lesions = model.vessel->coronaries->lesions;
  double out_m = 0;
  for (int i = 0; i < static_cast<int>(lesions.size()); ++i) {
    const auto stents = stented(model, state, i);
    const auto at = balloon_from_lesion_m(model, state, i);
    if (!stents || !at) continue;
    const Plan& plan = lesions[static_cast<std::size_t>(i)];
    const double half_m = model.treatment.balloons[static_cast<std::size_t>(balloon)].length_m / 2;
    const double middle_m = *at + (plan.to_m - plan.from_m) / 2;
    const double from_m = middle_m - half_m, to_m = middle_m + half_m;
    if (to_m < stents->from_m || from_m > stents->to_m) continue;
    out_m = std::max({out_m, stents->from_m - from_m, to_m - stents->to_m});
  }
  return out_m;
}

}  // namespace

void DeviceErrors::look(const SessionModel& model, const SessionState& state, const HandlingScene& x,
                        const EventSink& say) {
  const int balloon = state.bedside.balloon;
  if (x.device < 0 || balloon < 0) {
    *this = {};
    return;
  }
  const HandledTool& own = x.tools[static_cast<std::size_t>(x.device)];
  const bool inflated = x.gauge_atm > 1;
  if (inflated && !open_) open_ = true, opened_at_m_ = own.fed_m;
  if (!inflated && !x.filled) open_ = false;
  if (dragged_.begins(open_ && std::fabs(own.fed_m - opened_at_m_) > dragged_m, x.time_s))
    say(EventCode::open_balloon_dragged, x.device, 1e3 * (own.fed_m - opened_at_m_));
  const double for_s = inflated_for_.seconds(inflated, x.time_s);
  const bool shifted = inflated && ST_shift_mV(model.physiology.ischaemia, state.blood.ischaemia) >= shift_mV;
  if (long_.begins(for_s > longest_s, x.time_s)) say(EventCode::long_inflation, x.device, for_s);
  if (ischaemic_.begins(shifted_for_.seconds(shifted, x.time_s) > after_shift_s, x.time_s))
    say(EventCode::long_inflation, x.device, for_s);
  const bool hard = state.treatment.balloon.pressure_Pa > beyond_atm * 101325;
  const double beyond = hard ? beyond_stent_m(model, state, balloon) : 0;
  if (beyond_.begins(beyond > beyond_m, x.time_s)) say(EventCode::balloon_beyond_stent, x.device, 1e3 * beyond);
}

}  // namespace ostium
