#include "data/formats/write_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstring>
#include <deque>
#include <filesystem>

#include "data/formats/paths.h"

namespace ostium::data {

namespace fs = std::filesystem;

WriteError write_error(const std::string& path, const std::string& why) {
  return WriteError(path + ": cannot be written" + (why.empty() ? "" : " (" + why + ")") +
                    "; does its folder exist, may you write there, and is there room?");
}

namespace {

/// Makes the file and locks it; -1 where it cannot be made, which its writer finds and says. Throws WriteError.
int locked(const std::string& beside, const std::string& path) {
  for (;;) {
    const int file = open(beside.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
    if (file < 0) return -1;
    if (flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      close(file);
      throw WriteError(path + ": another program is writing it; wait for its end, or name another file");
    }
    struct stat mine {
    }, there{};
    if (fstat(file, &mine) == 0 && stat(beside.c_str(), &there) == 0 && mine.st_ino == there.st_ino) return file;
    close(file);  // whoever wrote it gave it its name just now
  }
}

/// Throws WriteError.
void put(std::string_view bytes, const NewFile& file) {
  std::FILE* out = std::fopen(file.beside().c_str(), "wb");
  if (!out) throw write_error(file.path(), std::strerror(errno));
  errno = 0;
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), out) == bytes.size() && std::fflush(out) == 0;
  const std::string why = written ? "" : std::strerror(errno);
  if (std::fclose(out) != 0 || !written) throw write_error(file.path(), why);
}

}  // namespace

std::string behind_links(std::string path) {
  std::error_code none;
  constexpr int most_links = 40;  // as the kernel has it
  for (int links = 0; links < most_links && fs::is_symlink(path, none); ++links)
    path = (fs::path(path).parent_path() / fs::read_symlink(path, none)).string();
  return path;
}

NewFile::NewFile(const std::string& path) : path_(behind_links(path)) {
  std::error_code none;
  // A name may be as long as the file system takes: then the other is made of its beginning.
  const std::string ending = ".unfinished", name = fs::path(path_).filename().string();
  beside_ = path_.substr(0, path_.size() - name.size()) + name.substr(0, NAME_MAX - ending.size()) + ending;
  if (const fs::path folder = fs::path(path_).parent_path(); !folder.empty()) fs::create_directories(folder, none);
  // Neither a device nor a folder can be replaced; what is written to a folder fails.
  if (fs::exists(path_, none) && !fs::is_regular_file(path_, none)) beside_ = path_;
  if (beside_ == path_) return;
  if (is_there(beside_) && !is_file(beside_))  // a pipe would wait for its reader
    throw WriteError(fmt::format("{}: cannot be written, as it is made in {}, and {}; remove that", path, beside_,
                                 why_no_file(beside_)));
  lock_ = locked(beside_, path_);
}

NewFile::~NewFile() {
  if (!over_ && beside_ != path_) std::remove(beside_.c_str());
  if (lock_ >= 0) close(lock_);
}

void NewFile::finish() {
  over_ = true;
  if (beside_ == path_ || std::rename(beside_.c_str(), path_.c_str()) == 0) return;
  const std::string why = std::strerror(errno);
  std::remove(beside_.c_str());
  throw write_error(path_, why);
}

void require_place_for(const std::string& file) {
  std::error_code none;
  if (file.empty()) throw WriteError("a file without a name cannot be written; expected a name");
  if (is_folder(file)) throw write_error(file, "it is a folder, not a file");
  if (fs::exists(file, none) && !is_file(file)) return;  // a device takes what comes
  fs::path folder = fs::weakly_canonical(fs::absolute(file, none), none).parent_path();
  while (folder.has_relative_path() && !is_there(folder)) folder = folder.parent_path();  // the rest is made
  if (!folder.empty() && access(folder.c_str(), W_OK | X_OK) != 0)
    throw write_error(file, std::strerror(is_folder(folder) ? errno : ENOTDIR));
}

void write_file(const std::string& path, std::string_view bytes) {
  NewFile file(path);
  put(bytes, file);
  file.finish();
}

void write_files(const std::vector<FileText>& files) {
  std::deque<NewFile> written;
  for (const FileText& file : files) put(file.bytes, written.emplace_back(file.path));
  for (NewFile& file : written) file.finish();
}

}  // namespace ostium::data
