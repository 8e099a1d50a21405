#pragma once
/// Pictures of a session: any view, also one that was never shown. A film is the same whenever it is made.
#include <memory>

#include "app/session/scene/dose.h"
#include "app/session/scene/frames.h"
#include "app/session/scene/monitor.h"
#include "app/session/scene/xray_scene.h"
#include "fluoro/console/fluoroscope.h"

namespace ostium::app {

/// How a film differs from what the operator saw. What is not set follows the recorded inputs.
struct FilmOptions {
  std::optional<double> lao_rad, cran_rad, field_m;
  std::optional<Eigen::Vector3d> p_PI;
  std::optional<fluoro::Mode> mode;  ///< whose dose; not set: of the pedal that is down, fluoroscopy's where none is
  bool always_on = true;             ///< false: black where no pedal was down
  double frames_per_s = 15;
  int pixels = 512;
  bool overlay = true;
  bool monitor = false;  ///< ECG, pressure and gauge under the picture; of a case alone
  Fill fill = Fill::none;
  std::uint64_t seed = 1;  ///< of the noise
};

inline constexpr int monitor_pixels = 144;  ///< that the monitor's strips are high

class Film {
 public:
  /// Throws std::invalid_argument for a rate or pose that cannot be.
  Film(const SessionModel& model, const FilmOptions& options);
  ~Film();
  /// After every step that is to be on the monitor.
  void listen(const SessionModel& model, const SessionState& state, const SessionInputs& inputs);
  Monitor& monitor();  ///< what it has heard
  int height() const;  ///< of a frame, pixels; it is `pixels` wide
  /// The state as a picture; `xrays`: what the run has used by then, shown or not, which only the overlay tells.
  /// Throws std::invalid_argument as fluoro's `tick` does.
  const fluoro::Picture& frame(const SessionModel& model, const SessionState& state, const SessionInputs& inputs,
                               const XrayUse& xrays = {});
  fluoro::CineRun run() const;            ///< with the last exposure, without frames
  const fluoro::DoseMeter& dose() const;  ///< as the last overlay said

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace ostium::app
