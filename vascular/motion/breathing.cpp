#include "vascular/motion/breathing.h"

#include <cmath>

namespace ostium::vascular {

void step(double rate_1_min, BreathAsked asked, bool awake, double dt_s, BreathState& s) {
  if (!(rate_1_min > 0)) return;
  if (asked == BreathAsked::free) s.held_s = 0, s.tired = false;
  const double before = s.phase, after = before + rate_1_min / 60 * dt_s;
  const bool holds = asked != BreathAsked::free && awake && !s.tired;
  const double stop = asked == BreathAsked::in ? 0.5 : 1;  // a phase of 1 is one of 0
  const bool there = holds && (s.held_s > 0 || (before < stop && after >= stop) || before == std::fmod(stop, 1));
  if (!there) {
    s.phase = after - std::floor(after);
    return;
  }
  s.phase = std::fmod(stop, 1), s.held_s += dt_s;
  if (s.held_s >= longest_hold_s) s.held_s = 0, s.tired = true;
}

}  // namespace ostium::vascular
