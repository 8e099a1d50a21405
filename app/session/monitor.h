#pragma once
/// What a case's monitor shows beside the X-rays: ECG, the guide's pressure, the gauge, of the last seconds.
#include "app/session/session.h"
#include "fluoro/overlay.h"

namespace ostium {

inline constexpr double monitor_s = 5;  ///< that strips show

struct Monitor {
  static constexpr double samples_per_s = 250;
  Strip II{"II", "mV", samples_per_s, {}, -0.3, 1.15};
  Strip V2{"V2", "mV", samples_per_s, {}, -1.0, 0.8};
  Strip guide{"P", "mmHg", samples_per_s, {}, 0, 150};
  Strip gauge{"gauge", "atm", samples_per_s, {}, -2, 22};

  /// After every step; of a mesh there is nothing to hear.
  void listen(const SessionModel& model, const SessionState& state, const SessionInputs& inputs);
};

}  // namespace ostium
