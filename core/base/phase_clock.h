#pragma once
/// Where the time of a piece of work goes: ticks of the processor's time stamp counter, by phase. For profiles; what is
/// computed does not depend on it.
#include <x86intrin.h>

#include <array>
#include <cstdint>

namespace ostium::core {

class PhaseClock {
 public:
  static constexpr int most_phases = 24;

  /// From now on time counts for `phase`, >= 0. Returns the phase it counted for before; -1: none.
  int enter(int phase) {
    const std::uint64_t now = __rdtsc();
    if (phase_ >= 0) ticks[static_cast<std::size_t>(phase_)] += now - since_;
    since_ = now;
    const int before = phase_;
    phase_ = phase;
    return before;
  }

  std::array<std::uint64_t, most_phases> ticks{};

 private:
  int phase_ = -1;
  std::uint64_t since_ = 0;
};

/// While it lives, time counts for `phase` and not for the phase around it.
class InPhase {
 public:
  InPhase(PhaseClock* clock, int phase) : clock_(clock), around_(clock ? clock->enter(phase) : -1) {}
  ~InPhase() {
    if (clock_) clock_->enter(around_);
  }
  InPhase(const InPhase&) = delete;
  InPhase& operator=(const InPhase&) = delete;

 private:
  PhaseClock* clock_;  ///< null: time is not counted
  int around_;
};

}  // namespace ostium::core
