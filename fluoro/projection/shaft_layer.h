#pragma once
/// Instruments drawn from closed forms: if thinner than a pixel they are faint, not jagged.
///
/// A straight piece of a ring-shaped section (radii r_i < r_o), seen from the side, has the thickness 2 (sqrt(r_o^2 -
/// d^2) - sqrt(r_i^2 - d^2)) at the distance d from its axis, divided by sin(angle to the ray). A pixel takes the mean
/// over its width, from the closed-form integral; along the axis adjacent pieces share pixels in proportion, so that at
/// its joints none of a wire's material is lost or counted twice.
///
/// What moves during a pulse is spread evenly over the way that it goes meanwhile, half of it before and half after the
/// frame's moment. Optical depths are averaged, not what gets through: for a wire of 15 % the difference is 1 %.
#include <array>

#include "fluoro/matter/beam.h"
#include "fluoro/projection/path_lengths.h"

namespace ostium::fluoro {

/// Optical depth of the instruments at each of the beam's energies, and the columns touched in each row.
struct ShaftLayer {
  struct Touched {
    int from = 0, to = 0;  // one past the last; equal: none
  };
  std::array<Plane, energies> optical_depth;  ///< zero outside `touched`
  std::vector<Touched> touched;               ///< of each row

  explicit ShaftLayer(int pixels = 0) { resize(pixels); }
  void resize(int pixels);
  /// `pulse_s`: how long the picture is exposed.
  void draw(const View& view, const Beam& beam, std::span<const Shaft> shafts, double pulse_s = 0);
};

}  // namespace ostium::fluoro
