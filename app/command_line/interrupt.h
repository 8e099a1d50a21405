#pragma once
#include <atomic>

namespace ostium::app {

/// Becomes true when somebody wants the command to end. One for the process, as signals are.
inline std::atomic<bool> interrupted{false};
/// From here on Ctrl-C and SIGTERM set it, and no longer kill.
void stop_on_signals();

}  // namespace ostium::app
