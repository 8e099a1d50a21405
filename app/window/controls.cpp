#include "app/window/controls.h"

namespace ostium::app {

void Controls::press(Action action) {
  const unsigned at = pressed_.load(relaxed);
  if (at - taken_.load(std::memory_order_acquire) >= room - 1) return;
  queue_[at % room] = action;
  pressed_.store(at + 1, std::memory_order_release);
}

std::optional<Action> Controls::next() {
  const unsigned at = taken_.load(relaxed);
  if (at == pressed_.load(std::memory_order_acquire)) return std::nullopt;
  const Action action = queue_[at % room];
  taken_.store(at + 1, std::memory_order_release);
  return action;
}

}  // namespace ostium::app
