#include "app/command_line/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace ostium::app {

namespace {

bool on_terminal() { return isatty(STDERR_FILENO); }

}  // namespace

void show_progress(const std::string& what) {
  // Leaves the cursor at the start of the line, so that later output overwrites it.
  if (on_terminal()) fmt::print(stderr, "\033[K{}\r", what);
}

void LastingProblem::show(const std::string& when, std::string_view what) {
  const bool begins = last_ != what;
  last_ = what;
  if (what.empty()) return;
  show_progress(fmt::format("{}  {}", when, what));
  if (!begins || on_terminal()) return;
  fmt::print(stderr, "{}  {}\n", when, what);
  std::fflush(stderr);
}

void TimedProgress::operator()(const std::string& what) const {
  const double s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  const std::string line = fmt::format("{:5.1f} s  {}{}", s, of_, what);
  show_progress(line);
  if (!on_terminal() && s >= quiet_s_ && s >= logged_s_ + every_s_) fmt::print(stderr, "{}\n", line), logged_s_ = s;
  std::fflush(stderr);
}

}  // namespace ostium::app
