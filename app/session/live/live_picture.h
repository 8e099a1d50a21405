#pragma once
/// The live picture of a window or a browser: that of a film made at the same time, if there is one, else its own.
/// Pedals decide whoever presses them (keys, box, script): while none is pressed the last image is held. In review it
/// is a picture of a stored cine run.
#include <deque>
#include <optional>

#include "app/session/live/live_driver.h"
#include "app/session/live/reference.h"
#include "app/session/run/filming.h"
#include "app/session/scene/film.h"

namespace ostium::app {

struct LivePictureOptions {
  core::TripleBuffer<Filmed>* filmed = nullptr;  ///< null: takes its own pictures
  bool has_pedals = true;                        ///< false: nobody has any, so the beam is always on
  int pixels = 512;
  fluoro::Renderer renderer = fluoro::Renderer::scanline;
};

class LivePicture {
 public:
  LivePicture(const SessionModel& model, const LivePictureOptions& options);
  /// Whether there is something new to show; `fresh`: `now` is newer than at the last call.
  bool look(const Snapshot& now, bool fresh);
  const fluoro::Picture& picture() const { return shown_; }  ///< empty until the first exposure
  const Reference& reference() const { return reference_; }
  const fluoro::DoseMeter& dose() const { return dose_; }
  bool xray_on() const { return xray_on_; }
  bool cine() const { return cine_; }
  /// Of the run in review, counted from 1, and how many it has; 0: live.
  int review_frame() const { return review_frame_; }
  int review_frames() const { return review_frames_; }

 private:
  void take(const fluoro::Picture& picture, const fluoro::DoseMeter& dose, bool xray_on, bool cine, double seen);
  bool is_due(const Snapshot& now);
  void store(const fluoro::Picture& picture, bool cine);
  /// The run has gone back to that second: what was taken later is of a time that is given up.
  void forget_after(double second);
  /// What is shown: the live picture or one of a stored run, in the chosen greys.
  void show(const PictureSettings& settings);

  const SessionModel& model_;
  std::optional<Film> own_;
  core::TripleBuffer<Filmed>* filmed_;
  bool has_pedals_;
  std::size_t contrast_at_;  ///< in the signals
  fluoro::Picture picture_, shown_;
  Reference reference_;
  int references_ = 0;
  fluoro::DoseMeter dose_;
  bool xray_on_ = false, cine_ = false;
  int begun_ = 0;    ///< how often the run had gone back
  double due_ = -1;  ///< frames since the beginning, of the last exposure
  PictureSettings settings_;
  struct StoredRun {
    std::vector<fluoro::Picture> frames;
    double last_s = 0;  ///< when the last one was taken
  };
  std::deque<StoredRun> runs_;  ///< the last ones, the newest in front
  double second_ = 0;           ///< of what is shown
  int review_frame_ = 0, review_frames_ = 0;
};

}  // namespace ostium::app
