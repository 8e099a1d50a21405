#pragma once
/// MP4 video, made by the program ffmpeg, which is run beside us: linking it would bind our licence.
#include <string>

#include "fluoro/display/display.h"

namespace ostium::data {

/// Feeds frames to ffmpeg. What goes wrong (no ffmpeg, a full disk) ends the video and nothing else: `problem` then
/// says what, and further frames are ignored. Adding waits while ffmpeg is busy; do not call it from the simulation's
/// thread.
class VideoWriter {
 public:
  /// Frames of this size. Sizes that are odd are padded by a black line, as H.264 wants.
  VideoWriter(const std::string& file, int width, int height, double frames_per_s);
  ~VideoWriter();  ///< finishes
  VideoWriter(const VideoWriter&) = delete;
  VideoWriter& operator=(const VideoWriter&) = delete;

  void add(const fluoro::Picture& picture);
  /// Waits for ffmpeg's end. True if the whole video is written; a video that is not is removed.
  bool finish();
  const std::string& problem() const { return problem_; }  ///< empty while all is well
  long frames() const { return frames_; }                  ///< taken so far

 private:
  void stop(const std::string& why);
  std::string ffmpegs_words();

  std::string file_;
  int width_, height_;
  int to_ffmpeg_ = -1, words_ = -1;
  int process_ = -1;
  long frames_ = 0;
  std::string problem_;
};

}  // namespace ostium::data
