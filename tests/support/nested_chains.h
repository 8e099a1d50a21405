#pragma once
/// An independent solver for two nested instruments with play, in a plane: two chains of segments by their angles,
/// clamped at the same place, whose energy is least where neither leaves the other's bore. Each has its own line; no
/// rotations in space, no shared centreline: nothing of `core` and of the effect that it judges goes in.
///
///   bending of both - F . tip of the inner + k h sum (|offset_i| - play)+^2 / 2
/// with offset_i of the outer's nodes from the inner one's line.
#include <Eigen/Core>
#include <vector>

namespace ostium::nested_chains {

struct Piece {
  double to_tip_m = 0;  ///< from the tip on; the last goes on for ever
  double EI_N_m2 = 0, curvature_per_m = 0;
};

struct Tube {
  std::vector<Piece> pieces;
  double inserted_m = 0;
};

struct Problem {
  Tube outer, inner;  ///< the inner one reaches further
  double play_m = 0;  ///< on each side
  Eigen::Vector2d tip_force_N = Eigen::Vector2d::Zero();
  double segment_m = 0.5e-3;
};

struct Solution {
  bool converged = false;
  std::vector<Eigen::Vector2d> outer, inner;  ///< from the base at the origin, along x, to the tips
};

Solution solve(const Problem& problem);

}  // namespace ostium::nested_chains
