#pragma once
/// What is being done, on stderr, for people who wait.
#include <chrono>
#include <string>

namespace ostium::app {

/// On a terminal: in place of the line before. Empty: clears it. Elsewhere nothing is said.
void show_progress(const std::string& what);

/// For work of minutes: with the seconds so far, and into logs too.
class TimedProgress {
 public:
  /// `of`: what every line begins with; `quiet_s`: logs are told only of what begins later than that.
  explicit TimedProgress(std::string of = "", double quiet_s = 0) : of_(std::move(of)), quiet_s_(quiet_s) {}
  void operator()(const std::string& what) const;

 private:
  std::string of_;
  double quiet_s_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace ostium::app
