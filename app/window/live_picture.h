#pragma once
/// The live picture of a window: that of a film made at the same time, if there is one, else its own. Pedals decide
/// whoever presses them (keys, box, script): while none is pressed the last image is held.
#include <optional>

#include "app/session/run/filming.h"
#include "app/session/scene/film.h"
#include "app/window/live_driver.h"

namespace ostium::app {

struct LivePictureOptions {
  core::TripleBuffer<Filmed>* filmed = nullptr;  ///< null: the window takes its own pictures
  bool has_pedals = true;                        ///< false: nobody has any, so the beam is always on
  double frames_per_s = 15;
  int pixels = 512;
};

class LivePicture {
 public:
  LivePicture(const SessionModel& model, const LivePictureOptions& options);
  /// Whether there is something new to show; `fresh`: `now` is newer than at the last call.
  bool look(const Snapshot& now, bool fresh);
  const fluoro::Picture& picture() const { return picture_; }  ///< empty until the first exposure
  const fluoro::DoseMeter& dose() const { return dose_; }
  bool cine() const { return cine_; }

 private:
  void take(const fluoro::Picture& picture, const fluoro::DoseMeter& dose, bool xray_on, bool cine);

  const SessionModel& model_;
  std::optional<Film> own_;
  core::TripleBuffer<Filmed>* filmed_;
  bool has_pedals_;
  fluoro::Picture picture_;
  fluoro::DoseMeter dose_;
  bool cine_ = false;
};

}  // namespace ostium::app
