#pragma once
/// What a keyboard, a mouse or a gamepad can ask for, whatever its keys are called.
///
/// The window's thread sets levels and queues actions; the thread that steps takes them. Neither waits for the other.
#include <array>
#include <atomic>
#include <optional>

namespace ostium::app {

/// Held, or moved so far: 0 to 1, of axes -1 to 1.
enum class Level {
  guide_feed,   ///< positive into the body
  guide_turn,   ///< positive clockwise as seen from the hub
  device_feed,  ///< of the tool in the right hand
  device_turn,
  fine,  ///< 1: a sixth of the speed
  fluoroscopy,
  cine,
  contrast,
  flush,
  vacuum
};
inline constexpr int levels = 10;

/// Once for each press.
enum class Action {
  swap,      ///< the right hand takes the next tool
  atm_up,    ///< indeflator
  atm_down,  ///< not below 0
  release,   ///< to 0
  left,      ///< the C-arm by 5 degrees
  right,
  cranial,
  caudal,
  table_left,  ///< by 10 mm
  table_right,
  table_up,
  table_down,
  zoom,       ///< the next of the detector's fields
  reference,  ///< the picture as it is becomes the one beside
  heparin,    ///< 5000 U
  nitrate,    ///< 200 ug
  mark,
  pause,
  help,
  quit,
  view_1,  ///< of the standard views, and so on to view_8
  view_2,
  view_3,
  view_4,
  view_5,
  view_6,
  view_7,
  view_8
};

class Controls {
 public:
  // --- of the window's thread
  void set(Level level, double value) { levels_[index(level)].store(static_cast<float>(value), relaxed); }
  /// Lost if 63 wait already: nobody presses that fast.
  void press(Action action);

  // --- of the one that steps
  double get(Level level) const { return levels_[index(level)].load(relaxed); }
  std::optional<Action> next();

 private:
  static constexpr auto relaxed = std::memory_order_relaxed;
  static constexpr unsigned room = 64;
  static std::size_t index(Level level) { return static_cast<std::size_t>(level); }
  std::array<std::atomic<float>, levels> levels_{};
  std::array<Action, room> queue_{};
  std::atomic<unsigned> pressed_{0}, taken_{0};
};

}  // namespace ostium::app
