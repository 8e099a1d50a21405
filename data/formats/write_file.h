#pragma once
/// Files that appear whole or not at all: written beside their place, then renamed.
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace ostium::data {

/// Something could not be written, whatever the input was. The message names the file and the cure; exit code 1.
struct WriteError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A file that is being written. What has its name stays as it is until `finish`, and if that is never called. One
/// program writes it at a time; the lock is the kernel's (flock) and leaves nothing behind a program killed. A device
/// such as /dev/stdout is written to directly; of a link, the file that it leads to is replaced. Folders are made as
/// needed.
class NewFile {
 public:
  /// Throws WriteError if it is being written already.
  explicit NewFile(const std::string& path);
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;
  ~NewFile();  ///< removes what was written, unless it is finished

  const std::string& path() const { return path_; }
  /// Where to write: `path` + ".unfinished", in the same folder.
  const std::string& beside() const { return beside_; }
  /// Gives the file its name. Throws WriteError.
  void finish();

 private:
  std::string path_, beside_;
  bool over_ = false;
  int lock_ = -1;  ///< descriptor of `beside`
};

/// The file that links lead to, whether there is one or not yet; `path`, where it is no link.
std::string behind_links(std::string path);

/// Writes `bytes`. Throws WriteError; what was there is then as it was.
void write_file(const std::string& path, std::string_view bytes);

struct FileText {
  std::string path, bytes;
};

/// Several that belong together: all are written before the first of them gets its name. Throws WriteError.
void write_files(const std::vector<FileText>& files);

/// Throws WriteError if a file cannot be put there: found after hours of work it would be late.
void require_place_for(const std::string& file);

/// "FILE: cannot be written (why); ..."
WriteError write_error(const std::string& path, const std::string& why = "");

}  // namespace ostium::data
