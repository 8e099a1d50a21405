#include "app/session/handling/wire_errors.h"

#include <cmath>

namespace ostium {

namespace {

constexpr double side_m = 10e-3, blind_m = 10e-3;
constexpr double narrow_m = 0.5e-3, near_end_m = 10e-3, too_far_s = 5;
constexpr double drift_m = 5e-3, lost_m = 10e-3;

}  // namespace

void WireErrors::look_at_hand(const HandlingMap& map, const HandlingScene& x, const EventSink& say) {
  const HandledTool& wire = x.tools[static_cast<std::size_t>(x.thin_wire)];
  const double moved_m = wire.fed_m - fed_m_;
  fed_m_ = wire.fed_m;
  if (x.wire_cell < 0) return;
  blind_m_ = x.thin_tip_is_seen ? 0 : blind_m_ + std::fabs(moved_m);
  if (blind_.begins(blind_m_ > blind_m, x.time_s)) say(EventCode::blind_wire, x.thin_wire);
  const double unplanned_m = map.unplanned_m[static_cast<std::size_t>(x.wire_cell)];
  if (side_.begins(moved_m > 0 && unplanned_m > side_m, x.time_s))
    say(EventCode::side_branch_pushed, x.thin_wire, 1e3 * unplanned_m);
}

void WireErrors::look_at_place(const HandlingMap& map, const HandlingScene& x, const EventSink& say) {
  const auto cell = static_cast<std::size_t>(x.wire_cell);
  const bool too_far = x.wire_cell >= 0 && (map.healthy_m[cell] < narrow_m || map.to_end_m[cell] < near_end_m);
  if (too_far_.begins(too_far_for_.seconds(too_far, x.time_s) > too_far_s, x.time_s))
    say(EventCode::wire_too_far, x.thin_wire, 1e3 * map.to_end_m[cell]);
}

/// A device should slide over a wire that stays.
void WireErrors::look_at_drift(double along_m, const HandlingScene& x, const EventSink& say) {
  const bool device_moves = x.device >= 0 && x.tools[static_cast<std::size_t>(x.device)].advance_m_s != 0;
  if (x.tools[static_cast<std::size_t>(x.thin_wire)].advance_m_s != 0 || x.device < 0) parked_m_ = -1;
  if (parked_m_ < 0 && device_moves) parked_m_ = along_m;
  if (parked_m_ < 0 || std::fabs(along_m - parked_m_) < drift_m) return;
  say(EventCode::wire_drift, x.thin_wire, 1e3 * (along_m - parked_m_));
  parked_m_ = along_m;
}

/// What the hand drew back on purpose is no loss.
void WireErrors::look_at_loss(const HandlingMap& map, double along_m, const HandlingScene& x, const EventSink& say) {
  const double fed_m = x.tools[static_cast<std::size_t>(x.thin_wire)].fed_m;
  const bool behind = x.wire_cell >= 0 && map.behind_lesion[static_cast<std::size_t>(x.wire_cell)];
  if (behind && along_m >= farthest_m_) farthest_m_ = along_m, fed_at_farthest_m_ = fed_m;
  if (behind || farthest_m_ < 0) return;
  const double retreat_m = farthest_m_ - along_m, drawn_m = fed_at_farthest_m_ - fed_m;
  if (retreat_m - drawn_m > lost_m) say(EventCode::wire_position_lost, x.thin_wire, 1e3 * retreat_m);
  farthest_m_ = -1;
}

void WireErrors::look(const HandlingMap& map, const HandlingScene& x, const EventSink& say) {
  if (x.thin_wire < 0) {
    *this = {};
    return;
  }
  look_at_hand(map, x, say);
  look_at_place(map, x, say);
  if (!x.diastasis) return;
  const double along_m = x.wire_cell < 0 ? 0 : map.from_ostium_m[static_cast<std::size_t>(x.wire_cell)];
  look_at_drift(along_m, x, say);
  look_at_loss(map, along_m, x, say);
}

}  // namespace ostium
