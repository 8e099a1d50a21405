#pragma once
/// Breathing over time, and a breath that is held because someone asked for it.
#include "core/base/fields.h"

namespace ostium::vascular {

/// What a patient is asked to do. Who holds breathes on to the top or the bottom of the breath first, at the usual
/// pace, and holds it for 30 s at most [estimate]; then, or asleep, breathing goes on until it is asked anew.
enum class BreathAsked { free, in, out };
inline constexpr double longest_hold_s = 30;

struct BreathState {
  double phase = 0;    ///< [0, 1), of breath_depth (heart_cycle.h)
  double held_s = 0;   ///< since it is held
  bool tired = false;  ///< held as long as could be; until it is asked otherwise
};
constexpr auto fields(const BreathState*) {
  using S = BreathState;
  return std::tuple{core::field("phase", &S::phase), core::field("held_s", &S::held_s),
                    core::field("tired", &S::tired)};
}

/// `rate_1_min`: 0 does not breathe at all.
void step(double rate_1_min, BreathAsked asked, bool awake, double dt_s, BreathState& state);

}  // namespace ostium::vascular
