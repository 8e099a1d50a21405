#pragma once
/// A film of a run while it goes: a driver that changes nothing, and a thread of its own that takes the pictures.
#include <memory>
#include <string>

#include "app/session/run/run.h"
#include "app/session/scene/film.h"
#include "core/base/triple_buffer.h"

namespace ostium::app {

/// A picture of the film, for whoever watches.
struct Filmed {
  fluoro::Picture picture;  ///< without the monitor's strips
  fluoro::DoseMeter dose;
  bool xray_on = false, cine = false;  ///< pedals
};

/// Every frame is filmed: where pictures take longer than steps, steps wait.
class Filming : public Driver {
 public:
  /// `inner`: who drives; null: the script. Throws std::invalid_argument as Film does.
  Filming(const SessionModel& model, const std::string& mp4, const FilmOptions& options, Driver* inner = nullptr);
  ~Filming() override;  ///< finishes

  Driven drive(const ScriptedRun& run, SessionInputs& inputs) override;
  bool marks() override;
  void remark(std::vector<OperatorEvent>& events) override;
  bool holds_script() const override;

  /// The newest picture, for one other thread, from this call on: what is filmed need not be taken twice. They go on
  /// where the video has ended early.
  core::TripleBuffer<Filmed>& pictures();

  /// After the run: waits for the last picture. Empty, or what went wrong; the run is none the worse for it.
  std::string finish();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace ostium::app
