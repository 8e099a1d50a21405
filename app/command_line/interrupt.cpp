#include "app/command_line/interrupt.h"

#include <csignal>

namespace ostium::app {

namespace {

void answer_signals_with(const struct sigaction& answer) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before {};
    sigaction(signal, nullptr, &before);
    // What nohup ignores stays ignored. (A shell's background jobs are born with SIGINT ignored, and obey it all the
    // same.)
    if (signal != SIGHUP || before.sa_handler != SIG_IGN) sigaction(signal, &answer, nullptr);
  }
}

}  // namespace

void stop_on_signals() {
  struct sigaction ask_to_stop {};
  ask_to_stop.sa_handler = [](int signal) { interrupting_signal = signal, interrupted = true; };
  ask_to_stop.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  answer_signals_with(ask_to_stop);
}

EndsAtOnce::EndsAtOnce() {
  struct sigaction end {};
  end.sa_handler = SIG_DFL;
  answer_signals_with(end);
}

EndsAtOnce::~EndsAtOnce() {
  if (!interrupted) stop_on_signals();
}

}  // namespace ostium::app
