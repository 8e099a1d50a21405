#pragma once
/// Handling errors with any tool, and with the X-ray beam.
#include <tuple>
#include <vector>

#include "app/session/handling/episode.h"
#include "app/session/handling/scene.h"
#include "app/session/handling/session_event.h"

namespace ostium::app {

class PushWithoutAdvance {
 public:
  void look(const HandlingMap&, const HandlingScene& x, const EventSink& say) {
    pushes_.resize(x.tools.size());
    for (std::size_t t = 0; t < x.tools.size(); ++t) {
      const HandledTool& tool = x.tools[t];
      Push& push = pushes_[t];
      if (tool.in_body && tool.feed_m_s >= 0 && tool.fed_m - push.fed_m < pushed_m) continue;
      const bool stuck = tool.in_body && tool.feed_m_s > 0 && tool.along_m - push.along_m < gain_share * pushed_m &&
                         tool.push_N - push.push_N > rises_N;
      if (push.episode.begins(stuck, x.time_s))
        say(data::EventCode::push_without_advance, static_cast<int>(t), tool.push_N);
      push.fed_m = tool.fed_m, push.along_m = tool.along_m, push.push_N = tool.push_N;
    }
  }

 private:
  static constexpr double pushed_m = 15e-3, gain_share = 0.2, rises_N = 0.2;
  struct Push {
    double fed_m = 0, along_m = 0, push_N = 0;  ///< when the current 15 mm of pushing began
    Episode episode;
  };
  std::vector<Push> pushes_;  ///< one per tool
};

class IdleBeam {
 public:
  void look(const HandlingMap&, const HandlingScene& x, const EventSink& say) {
    bool busy = x.injects || x.is_inflated() || x.filled;
    for (const HandledTool& tool : x.tools) busy = busy || tool.feed_m_s != 0 || tool.turn_rad_s != 0;
    if (episode_.begins(x.beam && !busy, for_s, x.time_s)) say(data::EventCode::idle_beam);
  }

 private:
  static constexpr double for_s = 3;
  HeldEpisode episode_;
};

using OperationErrors = std::tuple<PushWithoutAdvance, IdleBeam>;

}  // namespace ostium::app
