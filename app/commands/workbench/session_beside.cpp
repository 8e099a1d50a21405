#include "app/commands/workbench/session_beside.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>

#include "data/formats/load_error.h"

namespace ostium::app {

namespace {

constexpr const char* link_begins = "trainer: ";

/// The last line that says something.
std::string last_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  const std::size_t end = text.rfind('\n');
  return end == std::string::npos ? text : text.substr(end + 1);
}

void end(int id) {
  kill(id, SIGTERM);
  int status = 0;
  while (waitpid(id, &status, 0) < 0 && errno == EINTR) {
  }
}

}  // namespace

SessionBeside::SessionBeside(const std::string& case_file, const std::string& script) {
  std::error_code none;
  const std::string program = std::filesystem::read_symlink("/proc/self/exe", none).string();
  std::array<std::string, 9> words = {program,  "serve", case_file,  "--hands", "browser",
                                      "--port", "0",     "--script", script};
  std::array<char*, 10> arguments{};
  for (std::size_t i = 0; i < words.size(); ++i) arguments[i] = words[i].data();
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0)
    throw data::LoadError(fmt::format("no session can be begun ({}); end other programs", std::strerror(errno)));
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&files, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&files, ends[1], STDERR_FILENO);
  const int failed = posix_spawn(&id_, program.c_str(), &files, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  close(ends[1]);
  std::string said;
  for (char letter = 0; !failed;) {
    const ssize_t count = read(ends[0], &letter, 1);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    said += letter;
    if (letter != '\n') continue;
    if (const std::size_t at = said.rfind(link_begins); at != std::string::npos) {
      link_ = said.substr(at + std::strlen(link_begins), said.size() - at - std::strlen(link_begins) - 1);
      break;
    }
  }
  close(ends[0]);
  if (!link_.empty()) return;
  if (!failed) end(id_);
  throw data::LoadError(said.empty() ? fmt::format("{}: cannot be run", program) : last_line(said));
}

SessionBeside::~SessionBeside() { end(id_); }

}  // namespace ostium::app
