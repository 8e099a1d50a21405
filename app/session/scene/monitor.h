#pragma once
/// The monitor of a case beside the X-rays: ECG, guide pressure and gauge over the last seconds.
#include "app/session/model/session.h"
#include "fluoro/display/overlay.h"

namespace ostium::app {

inline constexpr double monitor_s = 5;  ///< time span of the strips

struct Monitor {
  static constexpr double samples_per_s = 250;
  fluoro::Strip II{"II", "mV", samples_per_s, {}, -0.3, 1.15};
  fluoro::Strip V2{"V2", "mV", samples_per_s, {}, -1.0, 0.8};
  fluoro::Strip guide{"P", "mmHg", samples_per_s, {}, 0, 150};
  fluoro::Strip gauge{"gauge", "atm", samples_per_s, {}, -2, 22};

  /// Call after every step; does nothing for a mesh.
  void listen(const SessionModel& model, const SessionState& state, const SessionInputs& inputs);
};

}  // namespace ostium::app
