#pragma once
/// From a scene to the detector's picture: path lengths, attenuation, scatter, noise, blur, glare, lag. An imager
/// belongs to one thread; it draws in that thread and starts no other.
#include <optional>

#include "fluoro/detector/attenuation.h"
#include "fluoro/detector/exposure.h"
#include "fluoro/detector/glare.h"
#include "fluoro/detector/lag.h"
#include "fluoro/detector/noise.h"

namespace ostium::fluoro {

/// Constant for the lifetime of an imager.
struct ImagerModel {
  Detector detector;
  ScatterKernel scatter;
  GlareKernel glare;
  double grid_transmission = 0.7;    ///< of primary radiation
  double focal_spot_m = 0.6e-3;      ///< blur grows with the magnification of the isocentre
  double detector_blur_m = 0.16e-3;  ///< standard deviation of the scintillator's light: MTF 0.6 at 1/mm
  double shutter_blur_m = 1.2e-3;    ///< standard deviation of the shutters' shadow at the detector
};

struct FrameInput {
  const Scene& scene;
  View view;
  Collimator collimator;
  Programme programme;
  std::uint64_t seed = 1;
};

/// State carried from frame to frame.
struct ImagerState {
  std::uint64_t frame = 0;
  Lag lag;
};

struct FrameReport {
  Exposure exposure;
  Leak leak;  ///< a surface that is open or badly placed
};

class Imager {
 public:
  /// Rethrows what making the renderer throws.
  explicit Imager(const ImagerModel& model, std::unique_ptr<PathLengthRenderer> renderer);
  ~Imager();

  /// One frame; state.lag.shown is the picture, in absorbed photons of mean energy. With a leak the picture degrades
  /// (negative lengths count as zero) and the report says so.
  FrameReport frame(const FrameInput& in, ImagerState& state);
  /// Only dose and automatic brightness, from a coarse estimate, without a picture.
  Exposure exposure(const FrameInput& in);

  /// Names of the bodies that leak in a frame. Slow: draws each of them alone.
  std::string leaking(const FrameInput& in);

  const Plane& exposed() const { return exposed_; }  ///< exposed area of the last frame, 0 to 1
  /// Path lengths of the last frame, for measurements.
  const PathLengths& lengths() const { return lengths_; }
  const PathLengthRenderer& renderer() const { return *renderer_; }

 private:
  void draw(const FrameInput& in);
  void collimate(const FrameInput& in);

  ImagerModel model_;
  std::unique_ptr<PathLengthRenderer> renderer_, coarse_renderer_;
  Beams beams_;
  // Cached while neither the C-arm nor the fixed scene changes:
  std::shared_ptr<const std::vector<Body>> fixed_, coarse_fixed_;
  std::optional<View> view_, coarse_view_;
  PathLengths fixed_lengths_, coarse_fixed_lengths_;
  Plane stretch_;
  Collimator collimator_;
  bool shuttered_ = false;
  Plane exposed_;
  // Scratch.
  PathLengths lengths_, coarse_;
  ShaftLayer shafts_;
  Primary primary_;
  Plane scattered_, counted_, scratch_;
};

}  // namespace ostium::fluoro
