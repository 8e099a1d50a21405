#pragma once
/// An independent solver for a wire that is pushed into a bent tube, and drawn back: a plane chain of segments by their
/// angles, its energy minimised in small increments of insertion, with a wall and a friction of its own. No rotations
/// in space, no time, no mesh: nothing of `core`, and nothing of its method, goes in.
///
/// Each increment minimises, over the angles,
///   bending + weight + k h sum depth_i^2 / 2 + mu sum N_i (sqrt(u_i^2 + e^2) - e)
/// with depth_i of the nodes beyond the wall, u_i how far they have slid along it in this increment, and N_i the force
/// of the wall that this makes, found by repeating (Coulomb's law as incremental dissipation, Ortiz, Stainier 1999,
/// Comput Methods Appl Mech Eng 171:419).
#include <Eigen/Core>
#include <vector>

namespace ostium::pushed_chain {

/// The plane of the tube: x along its beginning, z to the side that it bends to. SI.
struct Tube {
  double lead_m = 0;         ///< straight, from the origin along x
  double bend_radius_m = 1;  ///< of the centreline
  double angle_rad = 0;      ///< of the arc; beyond it goes on straight
  double radius_m = 0;       ///< of the lumen
};

/// From its tip on; the last goes on for ever.
struct Piece {
  double to_tip_m = 0;
  double EI_N_m2 = 0, kg_per_m = 0;
  double curvature_per_m = 0;  ///< at rest, turning towards z on the way to the tip
};

struct Wire {
  std::vector<Piece> pieces;
  double radius_m = 0;
};

struct Setting {
  double friction = 0;
  Eigen::Vector2d base_m = Eigen::Vector2d::Zero();  ///< on the tube's axis; held along x
  double gravity_m_s2 = 0;                           ///< along -z
  double segment_m = 1e-3;                           ///< and increment
  double wall_N_m2 = 2e7;                            ///< per length and depth; as it is, 1 N/m goes 0.05 um deep
};

struct Rest {
  bool converged = false;
  double inserted_m = 0;
  std::vector<Eigen::Vector2d> curve;  ///< x, z from the base to the tip, a node every segment
  double push_N = 0;                   ///< along x, what the base must do
};

/// The shapes at the insertions, in this order: a whole number of segments each, from outside, growing or shrinking.
std::vector<Rest> push(const Tube& tube, const Wire& wire, const Setting& setting, const std::vector<double>& inserted);

}  // namespace ostium::pushed_chain
