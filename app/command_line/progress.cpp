#include "app/command_line/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
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

double TimedProgress::elapsed_s() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void TimedProgress::say(Said& said) const {
  const double s = elapsed_s();
  const std::string line = fmt::format("{:5.1f} s  {}{}", s, of_, said.last);
  show_progress(line);
  if (s < quiet_s_ || s < said.logged_s + every_s_) return;
  said.logged_s = s;
  if (!on_terminal()) fmt::print(stderr, "{}\n", line);
  std::fflush(stderr);
}

void TimedProgress::operator()(const std::string& what) const {
  const std::lock_guard lock(said_->saying);
  said_->last = what;
  say(*said_);
}

void TimedProgress::go_on() const {
  const std::lock_guard lock(said_->saying);
  if (!said_->last.empty() && elapsed_s() >= std::max(quiet_s_, said_->logged_s + every_s_)) say(*said_);
}

}  // namespace ostium::app
