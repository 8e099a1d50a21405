#pragma once
/// The branch a tip is in, with hysteresis: at a border a tip would flicker between two, by steps or by heartbeats.
#include <cstdint>

#include "data/assessment/events.h"

namespace ostium::app {

class SettledBranch {
 public:
  /// Call with the branch at step `now` (-1: outside the body, reported at once). True once the tip has been in another
  /// branch for `tip_settles_s`, or back in the one before for `tip_returns_s`.
  bool comes_to(int branch, std::uint64_t now, double step_s) {
    if (branch != seen_) seen_ = branch, since_ = now;
    const double stays_s = branch == before_ ? data::tip_returns_s : data::tip_settles_s;
    if (branch == settled_ || (branch >= 0 && static_cast<double>(now - since_) * step_s < stays_s)) return false;
    before_ = branch < 0 ? -1 : settled_, settled_ = branch;
    return branch >= 0;
  }

 private:
  int settled_ = -1, seen_ = -1, before_ = -1;
  std::uint64_t since_ = 0;  ///< step since which the tip has been there
};

}  // namespace ostium::app
