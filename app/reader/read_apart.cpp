#include "app/reader/read_apart.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>

#include "app/reader/surface_bytes.h"
#include "data/formats/load_error.h"
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::app {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::size_t longest_refusal = 4096;  // bytes

std::string reader_set;  // empty: beside us

std::string reader_beside_us() {
  std::error_code no_proc;
  const fs::path reader = !reader_set.empty()
                              ? fs::path(reader_set)
                              : fs::read_symlink("/proc/self/exe", no_proc).parent_path() / "ostium-reader";
  if (!fs::exists(reader, no_proc))
    throw data::LoadError(reader.string() +
                          ": is not there, and files are read by it; build or install it beside ostium");
  return reader.string();
}

/// The reader as a child. Its end is waited for, or brought about.
class Child {
 public:
  explicit Child(const std::array<std::string, 4>& words) {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) fail(words[0]);
    from_ = ends[0];
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&files, ends[1], STDOUT_FILENO);
    // What libraries print as they die is not for people.
    posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    // A group of its own: Ctrl-C is for us, and the reader ends with us.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    std::array<char*, 5> arguments{};
    for (std::size_t i = 0; i < words.size(); ++i) arguments[i] = const_cast<char*>(words[i].c_str());
    errno = posix_spawn(&id_, words[0].c_str(), &files, &attributes, arguments.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    close(ends[1]);
    if (errno == 0) return;
    close(from_);
    fail(words[0]);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    close(from_);
    if (id_ > 0) kill(id_, SIGKILL), wait();
  }

  /// All that it writes until it closes its end; false where `until` came first.
  bool read_all(std::string& bytes, Clock::time_point until) {
    std::array<char, 65536> block;
    while (true) {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now()).count();
      pollfd readable{from_, POLLIN, 0};
      const int ready = left > 0 ? poll(&readable, 1, static_cast<int>(left)) : 0;
      if (ready == 0) return false;
      if (ready < 0) {
        if (errno == EINTR) continue;
        return false;
      }
      const ssize_t count = read(from_, block.data(), block.size());
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return true;
      bytes.append(block.data(), static_cast<std::size_t>(count));
    }
  }

  /// Its status, as waitpid has it.
  int wait() {
    int status = 0;
    while (waitpid(id_, &status, 0) < 0 && errno == EINTR) {
    }
    id_ = -1;
    return status;
  }

 private:
  [[noreturn]] static void fail(const std::string& program) {
    throw data::LoadError(fmt::format("{}: cannot be run ({}); files are read by it", program, std::strerror(errno)));
  }

  pid_t id_ = -1;
  int from_ = -1;
};

}  // namespace

void set_reader(const std::string& program) { reader_set = program; }

std::string read_apart(const ReaderCall& call, const std::string& file) {
  const std::string program = call.program.empty() ? reader_beside_us() : call.program;
  Child reader({program, call.kind, std::to_string(call.limits.seconds), file});
  std::string bytes;
  const bool in_time =
      reader.read_all(bytes, Clock::now() + std::chrono::seconds(ReaderLimits::patience * call.limits.seconds));
  const std::string too_long =
      fmt::format("{}: takes longer than {} s to read; {}", file, call.limits.seconds, call.cure);
  if (!in_time) throw data::LoadError(too_long);
  const int status = reader.wait();
  if (WIFSIGNALED(status)) {
    if (WTERMSIG(status) == SIGXCPU) throw data::LoadError(too_long);
    throw data::LoadError(fmt::format("{}: is damaged: what reads such files was ended by signal {} ({}); {}", file,
                                      WTERMSIG(status), strsignal(WTERMSIG(status)), call.cure));
  }
  if (WEXITSTATUS(status) == 0) return bytes;
  const std::string said = bytes.substr(0, std::min(longest_refusal, bytes.find('\0')));
  throw data::LoadError(!said.empty() ? said
                                      : fmt::format("{}: could not be read (its reader ended with code {}); {}", file,
                                                    WEXITSTATUS(status), call.cure));
}

namespace {

constexpr const char* mesh_cure = "expected a whole file: export it again, best as .stl, .ply or .vtp";

}  // namespace

std::string read_axes_apart(const std::string& file) { return read_apart({"axes", mesh_cure}, file); }

vascular::RawSurface read_surface_apart(const std::string& file) {
  try {
    return surface_of(read_apart({"mesh", mesh_cure}, file), file);
  } catch (const data::LoadError& error) {
    throw vascular::MeshError(error.what());
  }
}

void require_whole_recording(const std::string& file) {
  // 70 MB take 0.7 s. What is damaged may be read for ever.
  std::error_code none;
  const auto size = fs::file_size(file, none);
  const unsigned seconds = none ? 60 : static_cast<unsigned>(std::min<std::uintmax_t>(60, 5 + size / 2'000'000));
  read_apart({"recording", "expected a recording of `ostium run` as it was written: copy it again", {seconds}}, file);
}

}  // namespace ostium::app
