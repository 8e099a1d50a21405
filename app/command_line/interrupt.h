#pragma once
#include <atomic>

namespace ostium::app {

/// Becomes true when the user asks the command to end. Global, as signals are.
inline std::atomic<bool> interrupted{false};
/// From this call on, Ctrl-C and SIGTERM set `interrupted` instead of killing the process.
void stop_on_signals();

}  // namespace ostium::app
