#include "app/commands/dataset/run_locks.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "data/formats/load_error.h"
#include "data/formats/write_file.h"

namespace ostium::app {

namespace {

/// Beyond any run: whoever has it reads or writes the set's name, or what is made of all runs.
constexpr off_t of_the_name = off_t{1} << 40;

/// Whether no other program has the byte.
bool lock(int descriptor, off_t byte, bool waits) {
  struct flock one {};
  one.l_type = F_WRLCK, one.l_whence = SEEK_SET, one.l_start = byte, one.l_len = 1;
  int rc;
  do rc = fcntl(descriptor, waits ? F_OFD_SETLKW : F_OFD_SETLK, &one);
  while (rc != 0 && waits && errno == EINTR);
  return rc == 0 || (errno != EAGAIN && errno != EACCES);
}

void unlock(int descriptor, off_t byte) {
  struct flock one {};
  one.l_type = F_UNLCK, one.l_whence = SEEK_SET, one.l_start = byte, one.l_len = 1;
  fcntl(descriptor, F_OFD_SETLK, &one);
}

/// The set that the file names; "": none yet.
std::string name_in(int descriptor) {
  char text[256];
  const ssize_t read = pread(descriptor, text, sizeof text, 0);
  std::string name(text, read > 0 ? static_cast<std::size_t>(read) : 0);
  if (!name.empty() && name.back() == '\n') name.pop_back();
  return name;
}

void keep(int descriptor, const std::string& file, const std::string& set, const std::vector<std::size_t>& runs) {
  lock(descriptor, of_the_name, true);
  const std::string there = name_in(descriptor);
  if (!there.empty() && there != set)
    throw data::LoadError(file + ": the folder is of another set of pictures; name another folder");
  const std::string line = set + "\n";
  if (there.empty() && pwrite(descriptor, line.data(), line.size(), 0) != static_cast<ssize_t>(line.size())) {
    const std::string why = std::strerror(errno);
    if (ftruncate(descriptor, 0) != 0) unlink(file.c_str());  // half a name would be another set's
    throw data::write_error(file, why);
  }
  unlock(descriptor, of_the_name);
  for (const std::size_t run : runs)
    if (!lock(descriptor, static_cast<off_t>(run), false))
      throw data::LoadError(std::filesystem::path(file).parent_path().string() +
                            ": another ostium makes these pictures; wait for its end, or name another folder");
}

}  // namespace

RunLocks::RunLocks(const std::string& file, const std::string& set, const std::vector<std::size_t>& runs)
    : descriptor_(open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
  if (descriptor_ < 0) throw data::write_error(file, std::strerror(errno));
  try {
    keep(descriptor_, file, set, runs);
  } catch (...) {
    close(descriptor_);
    throw;
  }
}

void RunLocks::keep_others_from_finishing() const { lock(descriptor_, of_the_name, true); }

RunLocks::~RunLocks() { close(descriptor_); }

}  // namespace ostium::app
