#pragma once
/// A session on a case as a program of its own, beside this one: `ostium serve`, with the browser's hands.
#include <string>

namespace ostium::app {

class SessionBeside {
 public:
  /// `script`: whose instruments lie ready. Waits until its page is there. Throws LoadError with what it says where it
  /// does not begin.
  SessionBeside(const std::string& case_file, const std::string& script);
  SessionBeside(const SessionBeside&) = delete;
  SessionBeside& operator=(const SessionBeside&) = delete;
  ~SessionBeside();  ///< ends it

  const std::string& link() const { return link_; }

 private:
  int id_ = -1;
  std::string link_;
};

}  // namespace ostium::app
