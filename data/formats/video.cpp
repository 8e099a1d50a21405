#include "data/formats/video.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <vector>

extern char** environ;

namespace ostium::data {

VideoWriter::VideoWriter(const std::string& file, int width, int height, double frames_per_s)
    : file_(file), out_(file), width_(width), height_(height) {
  // A pair of sockets rather than a pipe: a write to an ffmpeg that has exited then fails instead of raising SIGPIPE.
  int in[2], words[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, in) || pipe2(words, O_CLOEXEC)) {
    problem_ = file_ + ": no video: " + std::strerror(errno);
    return;
  }
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, in[1], STDIN_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, words[1], STDERR_FILENO);
  const std::string size = fmt::format("{}x{}", width, height), rate = fmt::format("{}", frames_per_s);
  std::vector<std::string> arguments{"ffmpeg",      "-y",        "-loglevel",  "error",
                                     "-f",          "rawvideo",  "-pix_fmt",   "gray",
                                     "-video_size", size,        "-framerate", rate,
                                     "-i",          "-",         "-vf",        "pad=ceil(iw/2)*2:ceil(ih/2)*2",
                                     "-c:v",        "libx264",   "-crf",       "25",
                                     "-preset",     "superfast", "-pix_fmt",   "yuv420p",
                                     "-f",          "mp4",       out_.beside()};
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  // In a group of its own: Ctrl-C would end ffmpeg before it has the last frames.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  const int failed = posix_spawnp(&process_, "ffmpeg", &actions, &attributes, argv.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  close(in[1]);
  close(words[1]);
  to_ffmpeg_ = in[0];
  words_ = words[0];
  if (failed) {
    process_ = -1;
    stop(fmt::format("ffmpeg cannot be run ({}); is it installed?", std::strerror(failed)));
  }
}

VideoWriter::~VideoWriter() {
  finish();
  if (words_ >= 0) close(words_);
}

void VideoWriter::add(const fluoro::Picture& picture) {
  if (!problem_.empty() || to_ffmpeg_ < 0) return;
  if (picture.width != width_ || picture.height != height_) {
    stop(fmt::format("a frame of {} x {} in a video of {} x {}", picture.width, picture.height, width_, height_));
    return;
  }
  for (std::size_t sent = 0; sent < picture.grey.size();) {
    const ssize_t n = send(to_ffmpeg_, picture.grey.data() + sent, picture.grey.size() - sent, MSG_NOSIGNAL);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      stop("ffmpeg ended early");
      return;
    }
    sent += static_cast<std::size_t>(n);
  }
  ++frames_;
}

bool VideoWriter::finish() {
  if (to_ffmpeg_ >= 0) close(to_ffmpeg_);
  to_ffmpeg_ = -1;
  if (process_ < 0) return problem_.empty();
  const std::string words = ffmpegs_words();  // read to the end, so that ffmpeg never blocks on us
  int status = 0;
  while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  const bool good = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  if (good && problem_.empty()) try {
      out_.finish();
      return true;
    } catch (const WriteError& error) {
      problem_ = error.what();
      return false;
    }
  if (problem_.empty()) problem_ = file_ + ": the video ended";
  if (!words.empty()) problem_ += ": " + words;
  problem_ += fmt::format(" (after {} frames; is the disk full, does the folder exist?)", frames_);
  return false;
}

void VideoWriter::stop(const std::string& why) {
  problem_ = file_ + ": the video ended: " + why;
  finish();
}

std::string VideoWriter::ffmpegs_words() {
  std::string words;
  char buffer[512];
  for (ssize_t n; (n = ::read(words_, buffer, sizeof buffer)) > 0 || (n < 0 && errno == EINTR);)
    if (n > 0 && words.size() < 300) words.append(buffer, static_cast<std::size_t>(n));
  while (!words.empty() && words.back() == '\n') words.pop_back();
  for (char& c : words)
    if (c == '\n') c = ' ';
  return words;
}

}  // namespace ostium::data
