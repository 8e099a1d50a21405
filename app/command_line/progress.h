#pragma once
/// Progress messages on stderr.
#include <chrono>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

namespace ostium::app {

/// On a terminal, replaces the last message; an empty text clears it. Otherwise prints nothing.
void show_progress(const std::string& what);

/// A problem that lasts. On a terminal it is shown like progress; a log gets it once, when it begins.
class LastingProblem {
 public:
  /// `when`: stands before it; an empty `what`: there is no problem now.
  void show(const std::string& when, std::string_view what);

 private:
  std::string last_;
};

/// For work that takes minutes: adds the elapsed seconds, and also writes to logs. Copies are one; threads may share
/// it.
class TimedProgress {
 public:
  /// `of`: prefix of every line; `quiet_s`: logs get only messages that begin after this time, and one in `every_s`.
  explicit TimedProgress(std::string of = "", double quiet_s = 0, double every_s = 0)
      : of_(std::move(of)), quiet_s_(quiet_s), every_s_(every_s) {}
  void operator()(const std::string& what) const;
  /// Says the last message again, where it is as old as `every_s`.
  void go_on() const;

 private:
  struct Said {
    std::mutex saying;
    std::string last;
    double logged_s = -1e9;
  };
  void say(Said& said) const;
  double elapsed_s() const;

  std::string of_;
  double quiet_s_, every_s_;
  std::shared_ptr<Said> said_ = std::make_shared<Said>();
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace ostium::app
