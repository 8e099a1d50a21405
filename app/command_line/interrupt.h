#pragma once
#include <atomic>
#include <filesystem>
#include <vector>

namespace ostium::app {

/// Becomes true when the user asks the command to end. Global, as signals are.
inline std::atomic<bool> interrupted{false};
/// The signal that asked for it; 0: none did. The command then ends with exit code 128 + signal, as a shell says it.
inline std::atomic<int> interrupting_signal{0};
/// From this call on, Ctrl-C, SIGTERM and SIGHUP (a closed terminal) set both instead of killing the process. A second
/// one kills it.
void stop_on_signals();

/// A signal that kills the process at once first removes these folders where they are empty.
void leave_no_empty(const std::vector<std::filesystem::path>& folders);

/// While it lives, they kill the process at once, whatever stop_on_signals says: for what takes seconds and leaves
/// nothing, as a vessel that is built.
class EndsAtOnce {
 public:
  EndsAtOnce();
  EndsAtOnce(const EndsAtOnce&) = delete;
  EndsAtOnce& operator=(const EndsAtOnce&) = delete;
  ~EndsAtOnce();
};

}  // namespace ostium::app
