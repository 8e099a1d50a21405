#pragma once
#include <sys/stat.h>
#include <unistd.h>

#include <string>

namespace ostium::data {

/// Removes a partly written file; never a device such as /dev/full, nor a link to one.
inline void remove_unfinished(const std::string& file) {
  struct stat status {};
  if (lstat(file.c_str(), &status) == 0 && S_ISREG(status.st_mode)) unlink(file.c_str());
}

}  // namespace ostium::data
