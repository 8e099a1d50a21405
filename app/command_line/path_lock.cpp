#include "app/command_line/path_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "data/formats/load_error.h"

namespace ostium::app {

/// Without O_NONBLOCK a pipe of that name would wait for its other end.
PathLock::PathLock(const std::string& path, bool shared)
    : descriptor_(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
  if (descriptor_ < 0 || flock(descriptor_, (shared ? LOCK_SH : LOCK_EX) | LOCK_NB) == 0 || errno != EWOULDBLOCK)
    return;
  close(descriptor_);
  throw data::LoadError(path + ": another ostium writes there; wait for its end, or name another place");
}

PathLock::PathLock(PathLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

PathLock::~PathLock() {
  if (descriptor_ >= 0) close(descriptor_);
}

}  // namespace ostium::app
