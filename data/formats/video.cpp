#include "data/formats/video.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <vector>

extern char** environ;

namespace ostium::data {

namespace {

/// Whether the boxes of an MP4 file fill it to its end, and one says where the frames are (ISO/IEC 14496-12, 4.2):
/// ffmpeg exits with 0 where it could not write the last of them.
bool whole_mp4(const std::string& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const auto size = static_cast<std::uint64_t>(std::max<std::streamoff>(0, file.tellg()));
  bool has_frames = false;
  std::uint64_t at = 0;
  while (at < size) {
    std::array<unsigned char, 16> head{};
    file.seekg(static_cast<std::streamoff>(at));
    file.read(reinterpret_cast<char*>(head.data()), size - at < 16 ? 8 : 16);
    if (!file) return false;
    const auto number = [&](int from, int to) {
      std::uint64_t n = 0;
      for (int i = from; i < to; ++i) n = n << 8 | head[static_cast<std::size_t>(i)];
      return n;
    };
    const std::uint64_t length = number(0, 4) == 1 ? number(8, 16) : number(0, 4);  // 1: a longer number follows
    has_frames |= std::memcmp(head.data() + 4, "moov", 4) == 0;
    if (length < 8 || length > size - at) return false;
    at += length;
  }
  return has_frames;
}

}  // namespace

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
  // "file:", or what stands before a colon in the name (12:30.mp4) would be a protocol, and a name might be an option.
  std::vector<std::string> arguments{"ffmpeg",
                                     "-y",
                                     "-loglevel",
                                     "error",
                                     "-f",
                                     "rawvideo",
                                     "-pix_fmt",
                                     "gray",
                                     "-video_size",
                                     size,
                                     "-framerate",
                                     rate,
                                     "-i",
                                     "-",
                                     "-vf",
                                     "pad=ceil(iw/2)*2:ceil(ih/2)*2",
                                     "-c:v",
                                     "libx264",
                                     "-crf",
                                     "25",
                                     "-preset",
                                     "superfast",
                                     "-pix_fmt",
                                     "yuv420p",
                                     "-f",
                                     "mp4",
                                     "file:" + out_.beside()};
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
  if (frames_ == 0 && problem_.empty()) {
    problem_ = file_ + ": no film was made: there was no frame for it";
    return false;
  }
  const bool good = WIFEXITED(status) && WEXITSTATUS(status) == 0 && whole_mp4(out_.beside());
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
