#pragma once
/// Handling errors with the thick wire that leads catheters, and with the coronary wire.
#include <cmath>
#include <tuple>

#include "app/session/handling/episode.h"
#include "app/session/handling/scene.h"
#include "app/session/handling/session_event.h"

namespace ostium::app {

class WireStrays {
 public:
  void look(const HandlingMap& map, const HandlingScene& x, const EventSink& say) {
    if (x.thick_wire < 0) return;
    const double astray_m = map.astray_m[static_cast<std::size_t>(x.tool(x.thick_wire).sphere)];
    if (episode_.begins(astray_m > most_m, x.time_s)) say(data::EventCode::wire_strays, x.thick_wire, 1e3 * astray_m);
  }

 private:
  static constexpr double most_m = 20e-3;
  Episode episode_;
};

class WireInVentricle {
 public:
  void look(const HandlingMap& map, const HandlingScene& x, const EventSink& say) {
    if (x.thick_wire < 0) return;
    const bool inside = map.in_ventricle[static_cast<std::size_t>(x.tool(x.thick_wire).sphere)];
    if (episode_.begins(inside, for_s, x.time_s)) say(data::EventCode::wire_in_ventricle, x.thick_wire);
  }

 private:
  static constexpr double for_s = 2;
  HeldEpisode episode_;
};

class ThickWireInCoronary {
 public:
  void look(const HandlingMap& map, const HandlingScene& x, const EventSink& say) {
    if (x.thick_wire < 0) return;
    const double inside_m = map.in_coronary_m[static_cast<std::size_t>(x.tool(x.thick_wire).sphere)];
    if (episode_.begins(inside_m > most_m, x.time_s))
      say(data::EventCode::thick_wire_in_coronary, x.thick_wire, 1e3 * inside_m);
  }

 private:
  static constexpr double most_m = 5e-3;
  Episode episode_;
};

using ThickWireErrors = std::tuple<WireStrays, WireInVentricle, ThickWireInCoronary>;

// The coronary wire: when none is in the body, the record of the last one is cleared. Tip positions along the artery
// are compared only while the heart is at rest.

class BlindWire {
 public:
  void look(const HandlingMap&, const HandlingScene& x, const EventSink& say) {
    const double fed_m = x.tool(x.thin_wire).fed_m, moved_m = fed_m - fed_m_;
    fed_m_ = fed_m;
    if (x.wire_cell < 0) return;
    blind_m_ = x.thin_tip_is_seen ? 0 : blind_m_ + std::fabs(moved_m);
    if (episode_.begins(blind_m_ > most_m, x.time_s)) say(data::EventCode::blind_wire, x.thin_wire);
  }

 private:
  static constexpr double most_m = 10e-3;
  double fed_m_ = 0, blind_m_ = 0;
  Episode episode_;
};

/// A wire beside one that lies elsewhere protects a branch: it is where it should be.
class SideBranchPushed {
 public:
  void look(const HandlingMap& map, const HandlingScene& x, const EventSink& say) {
    const double fed_m = x.tool(x.thin_wire).fed_m;
    const bool pushed = fed_m - fed_m_ > 0;
    fed_m_ = fed_m;
    if (x.wire_cell < 0 || x.thin_wires > 1) return;
    const double unplanned_m = map.unplanned_m[static_cast<std::size_t>(x.wire_cell)];
    if (episode_.begins(pushed && unplanned_m > most_m, x.time_s))
      say(data::EventCode::side_branch_pushed, x.thin_wire, 1e3 * unplanned_m);
  }

 private:
  static constexpr double most_m = 10e-3;
  double fed_m_ = 0;
  Episode episode_;
};

class WireTooFar {
 public:
  void look(const HandlingMap& map, const HandlingScene& x, const EventSink& say) {
    const auto cell = static_cast<std::size_t>(x.wire_cell);
    const bool too_far = x.wire_cell >= 0 && (map.healthy_m[cell] < narrow_m || map.to_end_m[cell] < near_end_m);
    if (episode_.begins(too_far, for_s, x.time_s))
      say(data::EventCode::wire_too_far, x.thin_wire, 1e3 * map.to_end_m[cell]);
  }

 private:
  static constexpr double narrow_m = 0.5e-3, near_end_m = 10e-3, for_s = 5;
  HeldEpisode episode_;
};

/// Distance of its tip from the ostium; 0: not in an artery.
inline double wire_along_m(const HandlingMap& map, const HandlingScene& x) {
  return x.wire_cell < 0 ? 0 : map.from_ostium_m[static_cast<std::size_t>(x.wire_cell)];
}

/// A device should slide over a stationary wire.
class WireDrift {
 public:
  void look(const HandlingMap& map, const HandlingScene& x, const EventSink& say) {
    if (!x.diastasis) return;
    const double along_m = wire_along_m(map, x);
    const bool device_moves = x.device >= 0 && x.tool(x.device).feed_m_s != 0;
    if (x.tool(x.thin_wire).feed_m_s != 0 || x.device < 0) parked_m_ = -1;
    if (parked_m_ < 0 && device_moves) parked_m_ = along_m;
    if (parked_m_ < 0 || std::fabs(along_m - parked_m_) < most_m) return;
    say(data::EventCode::wire_drift, x.thin_wire, 1e3 * (along_m - parked_m_));
    parked_m_ = along_m;
  }

 private:
  static constexpr double most_m = 5e-3;
  double parked_m_ = -1;  ///< tip position when a device began to move; -1: none moves
};

/// Deliberate withdrawal by the hand does not count.
class WirePositionLost {
 public:
  void look(const HandlingMap& map, const HandlingScene& x, const EventSink& say) {
    if (!x.diastasis) return;
    const double along_m = wire_along_m(map, x), fed_m = x.tool(x.thin_wire).fed_m;
    const bool behind = x.wire_cell >= 0 && map.behind_lesion[static_cast<std::size_t>(x.wire_cell)];
    if (behind && along_m >= farthest_m_) farthest_m_ = along_m, fed_at_farthest_m_ = fed_m;
    if (behind || farthest_m_ < 0) return;
    const double retreat_m = farthest_m_ - along_m, drawn_m = fed_at_farthest_m_ - fed_m;
    if (retreat_m - drawn_m > most_m) say(data::EventCode::wire_position_lost, x.thin_wire, 1e3 * retreat_m);
    farthest_m_ = -1;
  }

 private:
  static constexpr double most_m = 10e-3;
  double farthest_m_ = -1, fed_at_farthest_m_ = 0;  ///< distal to the lesion; -1: not across it
};

using CoronaryWireErrors = std::tuple<BlindWire, SideBranchPushed, WireTooFar, WireDrift, WirePositionLost>;

}  // namespace ostium::app
