#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace ostium::app {

/// Keeps runs of a set for one program at a time, while others may make the other runs of the same set. Each run is a
/// byte of a file that names the set; the locks are the kernel's (of an open file, fcntl) and end with the process,
/// however that ends.
class RunLocks {
 public:
  /// Throws LoadError if the file names another set, or another program has one of the runs; WriteError. Where the file
  /// system knows no locks, there are none.
  RunLocks(const std::string& file, const std::string& set, const std::vector<std::size_t>& runs);
  RunLocks(const RunLocks&) = delete;
  RunLocks& operator=(const RunLocks&) = delete;
  ~RunLocks();
  /// Waits until no other program writes what is made of all runs.
  void keep_others_from_finishing() const;

 private:
  int descriptor_;
};

}  // namespace ostium::app
