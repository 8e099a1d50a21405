#pragma once
/// Where contrast was, laid over the live picture at the same moment of the beat.
#include <array>
#include <optional>

#include "fluoro/projection/path_lengths.h"

namespace ostium::fluoro {

/// The beat is cut into `moments`. In each, the first picture of a run is the mask, and what later ones have more
/// attenuation than it is the map: the most of it at each pixel.
class Roadmap {
 public:
  static constexpr int moments = 12;

  /// A picture of a run with contrast; the first beat should be without any.
  void record(const View& view, const Plane& signal, double beat_phase);
  /// Whether there is a map, taken from this very view.
  bool fits(const View& view) const { return view_ && *view_ == view; }
  /// The live signal with the map of that moment, or of the nearest that has one, drawn into it lighter than the live
  /// contrast would be.
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
