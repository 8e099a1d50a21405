#pragma once
/// An independent solver for a wire pushed into a bent tube and drawn back: a planar chain of segments described by
/// their angles, whose energy is minimised in small increments of insertion, with its own wall and friction. No spatial
/// rotations, no time, no mesh: it uses nothing of `core`, nor of its method.
///
/// Each increment minimises, over the angles,
///   bending + weight + k h sum depth_i^2 / 2 + mu sum N_i (sqrt(u_i^2 + e^2) - e)
/// with depth_i of the nodes beyond the wall, u_i their sliding along it in this increment, and N_i the resulting wall
/// force, found by iteration (Coulomb's law as incremental dissipation, Ortiz, Stainier 1999, Comput Methods Appl Mech
/// Eng 171:419).
#include <Eigen/Core>
#include <vector>

namespace ostium::pushed_chain {

/// The plane of the tube: x along its beginning, z towards the side it bends to. SI.
struct Tube {
  double lead_m = 0;         ///< straight, from the origin along x
  double bend_radius_m = 1;  ///< of the centreline
  double angle_rad = 0;      ///< of the arc; the tube continues straight beyond it
  double radius_m = 0;       ///< of the lumen
};

/// From its tip; the last one is unlimited.
struct Piece {
  double to_tip_m = 0;
  double EI_N_m2 = 0, kg_per_m = 0;
  double curvature_per_m = 0;  ///< at rest, turning towards z in the direction of the tip
};

struct Wire {
  std::vector<Piece> pieces;
  double radius_m = 0;
};

struct Setting {
  double friction = 0;
  Eigen::Vector2d base_m = Eigen::Vector2d::Zero();  ///< on the tube's axis; clamped along x
  double gravity_m_s2 = 0;                           ///< along -z
  double segment_m = 1e-3;                           ///< also the increment
  double wall_N_m2 = 2e7;                            ///< per length and depth; at this value 1 N/m penetrates 0.05 um
};

struct Rest {
  bool converged = false;
  double inserted_m = 0;
  std::vector<Eigen::Vector2d> curve;  ///< x, z from the base to the tip, one node per segment
  double push_N = 0;                   ///< force along x at the base
};

/// The shapes at these insertions, in this order: each a whole number of segments, starting outside, increasing or
/// decreasing.
std::vector<Rest> push(const Tube& tube, const Wire& wire, const Setting& setting, const std::vector<double>& inserted);

}  // namespace ostium::pushed_chain
