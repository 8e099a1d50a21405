#include "app/command_line/interrupt.h"

#include <csignal>

namespace ostium::app {

void stop_on_signals() {
  const auto ask_to_stop = [](int) { interrupted = true; };
  std::signal(SIGINT, ask_to_stop);
  std::signal(SIGTERM, ask_to_stop);
}

}  // namespace ostium::app
