#include "app/command_line/interrupt.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>

namespace ostium::app {

namespace {

void answer_signals_with(const struct sigaction& answer) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before {};
    sigaction(signal, nullptr, &before);
    // What nohup ignores stays ignored. (A shell's background jobs are born with SIGINT ignored, and obey it all the
    // same.)
    if (signal != SIGHUP || before.sa_handler != SIG_IGN) sigaction(signal, &answer, nullptr);
  }
}

constexpr std::size_t most_folders = 32, longest_path = 1024;
std::array<std::array<char, longest_path>, most_folders> empty_folders;  // a handler may not allocate
std::atomic<std::size_t> empty_folder_count{0};
bool stops = false;  // stop_on_signals was called

void end_at_once(int signal) {
  for (std::size_t round = 0; round < empty_folder_count; ++round)  // one may hold another that came later
    for (std::size_t i = 0; i < empty_folder_count; ++i) (void)rmdir(empty_folders[i].data());
  (void)std::raise(signal);  // by default again, once this returns
}

void end_on_signals() {
  struct sigaction end {};
  end.sa_handler = end_at_once;
  end.sa_flags = static_cast<int>(SA_RESETHAND);
  answer_signals_with(end);
}

}  // namespace

void leave_no_empty(const std::vector<std::filesystem::path>& folders) {
  std::size_t count = empty_folder_count;
  for (const std::filesystem::path& folder : folders) {
    const std::string path = std::filesystem::absolute(folder).string();
    if (count == most_folders || path.size() >= longest_path) break;
    std::copy_n(path.c_str(), path.size() + 1, empty_folders[count].begin());
    empty_folder_count = ++count;
  }
  if (!stops) end_on_signals();
}

void stop_on_signals() {
  stops = true;
  struct sigaction ask_to_stop {};
  ask_to_stop.sa_handler = [](int signal) { interrupting_signal = signal, interrupted = true; };
  ask_to_stop.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  answer_signals_with(ask_to_stop);
}

EndsAtOnce::EndsAtOnce() { end_on_signals(); }

EndsAtOnce::~EndsAtOnce() {
  if (!interrupted) stop_on_signals();
}

}  // namespace ostium::app
