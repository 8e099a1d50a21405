#pragma once
/// Instruments, drawn from closed forms: thinner than a pixel they are faint, not jagged.
///
/// A straight piece of a ring-shaped section (radii r_i < r_o), seen from the side, is 2 (sqrt(r_o^2 - d^2) -
/// sqrt(r_i^2 - d^2)) thick at the distance d from its axis, longer by 1 / sin(angle to the ray). A pixel takes the
/// mean of that over its width, from the integral in closed form; along the axis the pieces share pixels in proportion,
/// so that what a wire holds is neither lost nor counted twice at its joints.
#include <array>

#include "fluoro/matter/beam.h"
#include "fluoro/projection/path_lengths.h"

namespace ostium::fluoro {

/// Optical depth of the instruments at each of the beam's energies, and which columns of each row they touch.
struct ShaftLayer {
  struct Touched {
    int from = 0, to = 0;  // one beyond the last; equal: none
  };
  std::array<Plane, energies> optical_depth;  ///< zero outside `touched`
  std::vector<Touched> touched;               ///< of each row

  explicit ShaftLayer(int pixels = 0) { resize(pixels); }
  void resize(int pixels);
  void draw(const View& view, const Beam& beam, std::span<const Shaft> shafts);
};

}  // namespace ostium::fluoro
