#pragma once
/// Handling errors with guides and diagnostic catheters.
#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "app/session/handling/episode.h"
#include "app/session/handling/scene.h"
#include "app/session/handling/session_event.h"
#include "core/base/units.h"

namespace ostium::app {

/// Only between the sheath and the arch: in the root a shaped guide is moved without a wire.
class CatheterWithoutWire {
 public:
  void look(const HandlingMap& map, const HandlingScene& x, const EventSink& say) {
    if (x.catheter != catheter_) catheter_ = x.catheter, alone_m_ = inserted_m_ = 0;
    if (x.catheter < 0) return;
    const HandledTool& own = x.tool(x.catheter);
    const double advanced_m = std::max(0.0, own.inserted_m - inserted_m_);
    inserted_m_ = own.inserted_m;
    const int wire = x.thick_wire >= 0 ? x.thick_wire : x.thin_wire;
    const double leads_m = wire < 0 ? 0 : x.tool(wire).inserted_m - own.inserted_m;
    const bool led = leads_m >= led_m || !map.before_root[static_cast<std::size_t>(own.sphere)];
    alone_m_ = led ? 0 : alone_m_ + advanced_m;
    if (episode_.begins(alone_m_ > alone_m, x.time_s))
      say(data::EventCode::catheter_without_wire, x.catheter, 1e3 * leads_m);
  }

 private:
  static constexpr double led_m = 20e-3, alone_m = 10e-3;
  int catheter_ = -1;  ///< the tool the members below refer to
  double alone_m_ = 0, inserted_m_ = 0;
  Episode episode_;
};

class WoundUp {
 public:
  void look(const HandlingMap&, const HandlingScene& x, const EventSink& say) {
    if (x.catheter >= 0 && episode_.begins(std::fabs(x.twist_rad) > most_rad, for_s, x.time_s))
      say(data::EventCode::wound_up, x.catheter, 180 / units::pi * x.twist_rad);
  }

 private:
  static constexpr double most_rad = 1.5 * units::pi, for_s = 1;
  HeldEpisode episode_;
};

class TipWhips {
 public:
  void look(const HandlingMap&, const HandlingScene& x, const EventSink& say) {
    if (x.catheter != catheter_) catheter_ = x.catheter, looks_ = 0;
    if (x.catheter < 0) return;
    double& oldest = twists_rad_[looks_ % twists_rad_.size()];
    const double changed_rad = looks_ < twists_rad_.size() ? 0 : std::fabs(x.twist_rad - oldest);
    oldest = x.twist_rad, ++looks_;
    if (episode_.begins(changed_rad > most_rad, x.time_s))
      say(data::EventCode::tip_whips, x.catheter, 180 / units::pi * changed_rad);
  }

 private:
  static constexpr double most_rad = units::pi;
  int catheter_ = -1;                    ///< the tool the members below refer to
  std::array<double, 30> twists_rad_{};  ///< the last 0.3 s, one value per look
  std::size_t looks_ = 0;
  Episode episode_;
};

class DeepSeat {
 public:
  void look(const HandlingMap& map, const HandlingScene& x, const EventSink& say) {
    if (x.catheter < 0) return;
    const auto cell = static_cast<std::size_t>(x.catheter_cell);
    const bool deep = x.catheter_cell >= 0 && map.from_ostium_m[cell] > map.deep_m[cell];
    if (episode_.begins(deep, for_s, x.time_s))
      say(data::EventCode::deep_seat, x.catheter, 1e3 * map.from_ostium_m[cell]);
  }

 private:
  static constexpr double for_s = 2;
  HeldEpisode episode_;
};

class BadTraceKept {
 public:
  void look(const HandlingMap&, const HandlingScene& x, const EventSink& say) {
    if (x.catheter < 0) return;
    const bool bad = x.guide_trace == vascular::Trace::damped || x.guide_trace == vascular::Trace::ventricularised;
    if (episode_.begins(bad, for_s, x.time_s))
      say(data::EventCode::bad_trace_kept, x.catheter, static_cast<double>(x.guide_trace));
  }

 private:
  static constexpr double for_s = 5;
  HeldEpisode episode_;
};

using CatheterErrors = std::tuple<CatheterWithoutWire, WoundUp, TipWhips, DeepSeat, BadTraceKept>;

}  // namespace ostium::app
