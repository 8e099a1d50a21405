#pragma once
/// An independent solver for two nested instruments with play, in a plane: two chains of segments described by their
/// angles, clamped at the same point, whose energy is minimised such that neither leaves the other's bore. Each has its
/// own line; no spatial rotations, no shared centreline: it uses nothing of `core` or of the effect that it tests.
///
///   bending of both - F . tip of the inner + k h sum (|offset_i| - play)+^2 / 2
/// with offset_i the distance of the outer chain's nodes from the inner line.
#include <Eigen/Core>
#include <vector>

namespace ostium::nested_chains {

struct Piece {
  double to_tip_m = 0;  ///< from the tip; the last one is unlimited
  double EI_N_m2 = 0, curvature_per_m = 0;
};

struct Tube {
  std::vector<Piece> pieces;
  double inserted_m = 0;
};

struct Problem {
  Tube outer, inner;  ///< the inner one is longer
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
