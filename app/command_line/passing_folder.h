#pragma once
#include <string>

namespace ostium::app {

/// A folder of its own for what passes, which goes with it.
class PassingFolder {
 public:
  /// `command`: its name begins with "ostium-COMMAND-". Throws LoadError if none can be made.
  explicit PassingFolder(const std::string& command);
  ~PassingFolder();
  PassingFolder(const PassingFolder&) = delete;
  PassingFolder& operator=(const PassingFolder&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace ostium::app
