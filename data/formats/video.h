#pragma once
/// MP4 video, encoded by the ffmpeg program in its own process: linking to it would affect our licence.
#include <string>

#include "data/formats/write_file.h"
#include "fluoro/display/display.h"

namespace ostium::data {

/// Feeds frames to ffmpeg. Any failure (no ffmpeg, a full disk) ends only the video: `problem` then says what happened,
/// and further frames are ignored. Adding a frame blocks while ffmpeg is busy; do not call it from the simulation
/// thread.
class VideoWriter {
 public:
  /// Size and rate of the frames. Odd sizes are padded by a black line, as H.264 requires.
  VideoWriter(const std::string& file, int width, int height, double frames_per_s);
  ~VideoWriter();  ///< finishes
  VideoWriter(const VideoWriter&) = delete;
  VideoWriter& operator=(const VideoWriter&) = delete;

  void add(const fluoro::Picture& picture);
  /// Waits for ffmpeg to exit. True if the whole video was written; otherwise there is none,
  /// and an older one stays as it was.
  bool finish();
  const std::string& problem() const { return problem_; }  ///< empty if all is well
  long frames() const { return frames_; }                  ///< accepted so far

 private:
  void stop(const std::string& why);
  std::string ffmpegs_words();

  std::string file_;
  NewFile out_;
  int width_, height_;
  int to_ffmpeg_ = -1, words_ = -1;
  int process_ = -1;
  long frames_ = 0;
  std::string problem_;
};

}  // namespace ostium::data
