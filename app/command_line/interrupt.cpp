#include "app/command_line/interrupt.h"

#include <csignal>

namespace ostium::app {

void stop_on_signals() {
  struct sigaction ask_to_stop {};
  ask_to_stop.sa_handler = [](int signal) { interrupting_signal = signal, interrupted = true; };
  ask_to_stop.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(signal, &ask_to_stop, nullptr);  // nohup's wish stands
  }
}

}  // namespace ostium::app
