#pragma once
#include <string>

namespace ostium::app {

/// Keeps a folder, or a file, for one program at a time, so that two runs do not mix their files. The lock is the
/// kernel's (flock) and ends with the process, however that ends.
class FolderLock {
 public:
  FolderLock() = default;
  /// Throws LoadError if another program has it. Where the file system knows no locks, there is none.
  explicit FolderLock(const std::string& path);
  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&&) = delete;
  ~FolderLock();

 private:
  int descriptor_ = -1;
};

}  // namespace ostium::app
