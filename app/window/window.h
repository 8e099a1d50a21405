#pragma once
/// The live window: SDL's events into Controls, snapshots into pictures. Runs in the thread that called it, until the
/// window is closed or the run has ended; steps go on in another one.
#include <atomic>
#include <functional>
#include <string>

#include "app/session/live/live_driver.h"
#include "app/session/run/filming.h"
#include "app/window/panel.h"

namespace ostium::app {

/// Whether a window can be opened here; else `why` says why not.
bool has_display(std::string& why);

struct WindowOptions {
  bool has_pedals = true;  ///< false: nobody has any, neither keys nor box nor script; then the beam is always on
  int pixels = 512;
  fluoro::Renderer renderer = fluoro::Renderer::scanline;
  core::TripleBuffer<Filmed>* filmed =
      nullptr;  ///< of a film that is made as well; null: the window takes its own pictures
  /// Of whoever else drives: shown in red; may be empty.
  std::function<std::string()> problem;
  /// Of the picture, 0 to 1: it fades while the box's travel is at its end; may be empty: 1.
  std::function<double()> brightness;
  const std::atomic<bool>* over = nullptr;  ///< becomes true when the run has ended; its end is shown all the same
  /// For tests: the last picture is written here (a PNG); empty: nowhere.
  std::string last_frame_png;
};

/// Throws std::runtime_error if the window cannot be made. Returns pictures shown.
long show_window(const SessionModel& model, const ScriptPlan& plan, LiveDriver& hand, const WindowOptions& options);

}  // namespace ostium::app
