#pragma once
/// Roadmap: the earlier contrast, overlaid on the live picture at the same cardiac phase.
#include <array>
#include <optional>

#include "fluoro/projection/path_lengths.h"

namespace ostium::fluoro {

/// The cardiac cycle is divided into `moments`. In each, the first picture of a run is the mask, and the map is the
/// largest additional attenuation of later pictures at each pixel.
class Roadmap {
 public:
  static constexpr int moments = 12;

  /// Adds a picture of a contrast run; the first beat should be without contrast.
  void record(const View& view, const Plane& signal, double beat_phase);
  /// Whether there is a map, recorded in exactly this view.
  bool fits(const View& view) const { return view_ && *view_ == view; }
  /// The live signal with the map of that moment, or of the nearest recorded one, blended in fainter than live
  /// contrast.
  Plane over(const Plane& signal, double beat_phase) const;

 private:
  struct Moment {
    Plane mask;      // logarithm, smoothed a little
    Plane contrast;  // of the logarithm; >= 0
  };
  std::optional<View> view_;
  std::array<Moment, moments> moments_;
};

}  // namespace ostium::fluoro
