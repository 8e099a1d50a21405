#pragma once
/// Report of a step: troubles, and the forces of instruments on the hand and the walls.
#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace ostium::core {

/// Cases in which a step had to give way; bits of StepReport::trouble.
enum Trouble : std::uint32_t {
  drive_limited = 1u << 0,     ///< a drive beyond the limit in tolerances.h was reduced
  drive_not_finite = 1u << 1,  ///< a drive or load that is not a number was taken as zero
  load_limited = 1u << 2,      ///< a tip load beyond the limit in tolerances.h was reduced
  not_converged = 1u << 3,     ///< iterations ran out: `stretch` is above its tolerance; later steps make up for it
  motion_lost = 1u << 4,       ///< the rod moved too violently for a step and continued from rest
  no_solution = 1u << 5,       ///< no finite solution: the rod kept its shape, at rest
  feed_stopped = 1u << 6,      ///< the end of the instrument is reached: nothing left to push in or to pull back
  pulled_apart = 1u << 7,      ///< held ends pull a taut rod apart: their forces are not physical
  joint_overturned = 1u << 8,  ///< two elements meet at an angle near pi, where twist would slip: use shorter elements
};

struct RodReport {
  double push_N = 0;     ///< force of the hand along the base's d3
  double torque_Nm = 0;  ///< torque of the hand about it, right-handed
  /// Force and torque of the base's hold on the rod; zero if it is not held. Without the inertia of the half element at
  /// the base.
  Eigen::Vector3d base_force_W_N = Eigen::Vector3d::Zero();
  Eigen::Vector3d base_torque_W_Nm = Eigen::Vector3d::Zero();
  int iterations = 0;
  double stretch = 0;  ///< largest |(r_j+1 - r_j) / l_j - d3_j| over the elements after the step
  std::uint32_t trouble = 0;
};

/// Where a node touches a wall.
struct Touch {
  int rod = 0, node = 0;
  Eigen::Vector3d p_W;           ///< m
  Eigen::Vector3d normal_W_N;    ///< normal force of the wall on the rod
  Eigen::Vector3d friction_W_N;  ///< friction force of the wall on the rod
};

/// A contact between two rods, or of a rod with itself.
struct RodTouch {
  int rod = 0, node = 0;              ///< between this node and the next
  int other_rod = 0, other_node = 0;  ///< likewise
  Eigen::Vector3d p_W;                ///< m
  Eigen::Vector3d force_W_N;          ///< on `rod`; the other gets the opposite
};

/// What a step cost, in counts that are the same on every machine.
struct StepCounts {
  int iterations = 0;  ///< of Newton's method, over all strands and parts
  int solves = 0;      ///< linear solves, the first of each iteration included
  int eliminated = 0;  ///< elements that these eliminated
  int changes = 0;     ///< rounds in which ties to walls were changed
  int flips = 0;       ///< ties that were changed
  int clusters = 0;    ///< pieces of wall whose positions were computed
  int halvings = 0;    ///< of the step, since a part of it had no solution
  int retries = 0;     ///< from rest
};

struct StepReport {
  std::vector<RodReport> rods;  ///< reused between steps by the caller; sized at the first step
  std::vector<Touch> touches;   ///< at walls, by rod and node
  std::vector<RodTouch> rod_touches;
  std::uint32_t trouble = 0;  ///< of all rods
  /// How deep a node lies in a rigid wall that holds it, m, at most: by contact's own planes, at every step. For a
  /// judgement that shares nothing with contact see contact/penetration_oracle.h.
  double deepest_m = 0;
  StepCounts counts;
};

}  // namespace ostium::core
