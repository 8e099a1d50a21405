#pragma once
/// Frames are tied to steps, never to a clock.
#include <cmath>
#include <cstdint>

namespace ostium::app {

/// Whether a frame belongs to the state after that many steps: frame n to step round(n / (rate step)).
inline bool is_frame(std::uint64_t step, double frames_per_s, double step_s) {
  const double per_frame = 1 / (frames_per_s * step_s);
  const auto frame = static_cast<std::uint64_t>(std::llround(static_cast<double>(step) / per_frame));
  return static_cast<std::uint64_t>(std::llround(static_cast<double>(frame) * per_frame)) == step;
}

}  // namespace ostium::app
