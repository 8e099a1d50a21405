#pragma once
/// Handling errors with balloons and stents. When no device is in the body, the record of the last one is cleared.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "app/session/handling/episode.h"
#include "app/session/handling/scene.h"
#include "app/session/handling/session_event.h"

namespace ostium::app {

/// Beyond the guide: a shaft's own tip finds its way into the wall.
class DeviceWithoutWire {
 public:
  void look(const HandlingMap&, const HandlingScene& x, const EventSink& say) {
    const HandledTool& own = x.tool(x.device);
    const double advanced_m = inserted_m_ < 0 ? 0 : std::max(0.0, own.inserted_m - inserted_m_);
    inserted_m_ = own.inserted_m;
    const bool in_guide = x.catheter >= 0 && own.inserted_m <= x.tool(x.catheter).inserted_m;
    const double leads_m = x.wire_tip_m - own.inserted_m;
    alone_m_ = in_guide || leads_m > 0 ? 0 : alone_m_ + advanced_m;
    if (episode_.begins(alone_m_ > alone_m, x.time_s))
      say(data::EventCode::device_without_wire, x.device, 1e3 * leads_m);
  }

 private:
  static constexpr double alone_m = 5e-3;
  double alone_m_ = 0, inserted_m_ = -1;  ///< < 0: not looked at yet
  Episode episode_;
};

class OpenBalloonDragged {
 public:
  void look(const HandlingMap&, const HandlingScene& x, const EventSink& say) {
    const double fed_m = x.tool(x.device).fed_m;
    if (x.is_inflated() && !open_) open_ = true, opened_at_m_ = fed_m;
    if (!x.is_inflated() && !x.filled) open_ = false;
    if (episode_.begins(open_ && std::fabs(fed_m - opened_at_m_) > most_m, x.time_s))
      say(data::EventCode::open_balloon_dragged, x.device, 1e3 * (fed_m - opened_at_m_));
  }

 private:
  static constexpr double most_m = 2e-3;
  bool open_ = false;
  double opened_at_m_ = 0;  ///< fed length when it opened
  Episode episode_;
};

/// Too long by itself, or after an ST shift.
class LongInflation {
 public:
  void look(const HandlingMap&, const HandlingScene& x, const EventSink& say) {
    const double for_s = inflated_.seconds(x.is_inflated(), x.time_s);
    const bool shifted = x.is_inflated() && x.ST_mV >= shift_mV;
    if (long_.begins(for_s > longest_s, x.time_s)) say(data::EventCode::long_inflation, x.device, for_s);
    if (ischaemic_.begins(shifted, after_shift_s, x.time_s)) say(data::EventCode::long_inflation, x.device, for_s);
  }

 private:
  static constexpr double longest_s = 60, after_shift_s = 20, shift_mV = 0.2;
  Held inflated_;
  Episode long_;
  HeldEpisode ischaemic_;
};

class BalloonBeyondStent {
 public:
  void look(const HandlingMap&, const HandlingScene& x, const EventSink& say) {
    if (episode_.begins(x.beyond_stent_m > most_m, x.time_s))
      say(data::EventCode::balloon_beyond_stent, x.device, 1e3 * x.beyond_stent_m);
  }

 private:
  static constexpr double most_m = 2e-3;
  Episode episode_;
};

using DeviceErrors = std::tuple<DeviceWithoutWire, OpenBalloonDragged, LongInflation, BalloonBeyondStent>;

}  // namespace ostium::app
