#pragma once
/// Pictures of a session from any view, including ones never shown. A film is reproducible whenever it is made.
#include <memory>

#include "app/angiography/patient_scene.h"
#include "app/session/scene/dose.h"
#include "app/session/scene/frames.h"
#include "app/session/scene/monitor.h"
#include "app/session/scene/xray_scene.h"
#include "fluoro/console/fluoroscope.h"

namespace ostium::app {

/// How a film differs from what the operator saw. Unset options follow the recorded inputs.
struct FilmOptions {
  std::optional<double> lao_rad, cran_rad, field_m;
  std::optional<Eigen::Vector3d> p_PI;
  std::optional<fluoro::Mode> mode;  ///< sets the dose; unset: that of the pressed pedal, or fluoroscopy if none is
  bool always_on = true;             ///< false: black while no pedal was pressed
  double frames_per_s = 15;
  int pixels = 512;
  bool overlay = true;
  bool monitor = false;  ///< ECG, pressure and gauge below the picture; for cases only
  Fill fill = Fill::none;
  std::uint64_t seed = 1;  ///< of the noise
  fluoro::Renderer renderer = fluoro::Renderer::scanline;
};

/// What an operator changes between two frames.
struct FilmSettings {
  fluoro::Collimator shutters = fluoro::to_field;
  double frames_per_s = 15;  ///< 3.75, 7.5, 15, 30
  bool roadmap = false;      ///< over fluoroscopy in the view of the last cine run
};

inline constexpr int monitor_pixels = 144;  ///< height of the monitor's strips

class Film {
 public:
  /// `same`: the scene of the vessel's patient, if there is one already, which saves a second if it breathes or not as
  /// the model does. Throws std::invalid_argument for an impossible rate or pose.
  Film(const SessionModel& model, const FilmOptions& options, const PatientScene* same = nullptr);
  ~Film();
  /// As if no picture had been taken yet: noise of that seed, no lag.
  void restart(std::uint64_t seed);
  /// From the next frame on.
  void set(const FilmSettings& settings);
  /// Call after every step that is to appear on the monitor.
  void listen(const SessionModel& model, const SessionState& state, const SessionInputs& inputs);
  Monitor& monitor();  ///< the strips recorded so far
  int height() const;  ///< of a frame, pixels; its width is `pixels`
  /// The state as a picture; `xrays`: X-ray use so far, used by the overlay only. Throws std::invalid_argument as
  /// fluoro's `tick` does.
  const fluoro::Picture& frame(const SessionModel& model, const SessionState& state, const SessionInputs& inputs,
                               const XrayUse& xrays = {});
  /// The view that `frame` takes.
  fluoro::View view(const SessionInputs& inputs) const;
  fluoro::CineRun run() const;            ///< with the last exposure, without frames
  const fluoro::DoseMeter& dose() const;  ///< as shown in the last overlay

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace ostium::app
