#pragma once
#include <string>

namespace ostium::app {

/// Keeps a folder, or a file, for one program at a time, so that two runs do not mix their files. The lock is the
/// kernel's (flock) and ends with the process, however that ends. `shared`: for several that know of one another, as
/// the parts of a sweep, but for nobody else.
class PathLock {
 public:
  PathLock() = default;
  /// Throws LoadError if another program has it. Where the file system knows no locks, there is none.
  explicit PathLock(const std::string& path, bool shared = false);
  PathLock(PathLock&& other) noexcept;
  PathLock& operator=(PathLock&&) = delete;
  ~PathLock();

 private:
  int descriptor_ = -1;
};

}  // namespace ostium::app
