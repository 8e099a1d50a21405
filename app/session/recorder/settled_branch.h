#pragma once
/// Which branch a tip is in, for people: at the border between two it is now in one, now in the other.
#include <cstdint>

#include "data/assessment/events.h"

namespace ostium::app {

class SettledBranch {
 public:
  /// Takes where the tip is `now`, a step (-1: out of the body, which is known at once). True once it has been in
  /// another branch for `tip_settles_s`.
  bool comes_to(int branch, std::uint64_t now, double step_s) {
    if (branch != seen_) seen_ = branch, since_ = now;
    const bool settled = branch < 0 || static_cast<double>(now - since_) * step_s >= data::tip_settles_s;
    if (branch == settled_ || !settled) return false;
    settled_ = branch;
    return branch >= 0;
  }

 private:
  int settled_ = -1, seen_ = -1;
  std::uint64_t since_ = 0;  ///< that it is where it is seen
};

}  // namespace ostium::app
