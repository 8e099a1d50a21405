#pragma once
/// What one seat asks of the console (keyboard and gamepad, a browser), from its thread to the one that steps. Neither
/// waits for the other.
#include <array>
#include <atomic>
#include <optional>

#include "core/base/ring.h"
#include "data/console/console_commands.h"

namespace ostium::app {

using data::ConsoleCommand, data::ConsoleOrder;

class Controls {
 public:
  // --- of the seat's thread
  /// Held commands set their level, 0 when let go. Others wait in a queue; lost if 63 wait already: nobody presses that
  /// fast.
  void order(const ConsoleOrder& order) {
    if (data::row_of(order.command).held)
      set(order.command, order.values[0]);
    else
      queue_.put(order);
  }
  void order(ConsoleCommand command, double value = 0, double second = 0) { order({command, {value, second}}); }
  void set(ConsoleCommand held, double value) { levels_[index(held)].store(static_cast<float>(value), relaxed); }
  void let_all_go() {
    for (auto& level : levels_) level.store(0, relaxed);
  }

  // --- of the one that steps
  double get(ConsoleCommand held) const { return levels_[index(held)].load(relaxed); }
  std::optional<ConsoleOrder> next() { return queue_.next(); }

 private:
  static constexpr auto relaxed = std::memory_order_relaxed;
  static std::size_t index(ConsoleCommand command) { return static_cast<std::size_t>(command); }
  std::array<std::atomic<float>, data::held_commands> levels_{};
  core::Ring<ConsoleOrder, 64> queue_;
};

}  // namespace ostium::app
