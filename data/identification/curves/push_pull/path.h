#pragma once
/// The axis of a tube: straight, with bends of constant radius.
#include <vector>

namespace ostium::data::push_pull {

struct Bend {
  double at_m = 0, radius_m = 0, angle_rad = 0;  ///< begins so far from the entrance
  double end_m() const { return at_m + radius_m * angle_rad; }
};

/// Stiffness from the end of the piece before on, or from the tip, as far as `to_m` from the tip; the last has no end.
struct StiffPiece {
  double to_m = 0, EI_N_m2 = 0;
};

/// Where a wire presses on the wall, with how much.
struct WallForce {
  double at_m = 0, force_N = 0;
};

}  // namespace ostium::data::push_pull
