#pragma once
/// What a step tells: what it had to give way on, how instruments press the hand and the walls.
#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace ostium::core {

/// What a step had to give way on; bits of StepReport::trouble.
enum Trouble : std::uint32_t {
  drive_limited = 1u << 0,     ///< a drive was faster than tolerances.h allows, and was shortened
  drive_not_finite = 1u << 1,  ///< a drive or load was not a number, and was taken as zero
  load_limited = 1u << 2,      ///< a tip load was larger than tolerances.h allows, and was shortened
  not_converged = 1u << 3,     ///< the iterations ran out: `stretch` is above its tolerance, later steps take it back
  motion_lost = 1u << 4,       ///< the rod moved too violently for a step, and went on from rest
  no_solution = 1u << 5,       ///< the system had no finite solution: the rod kept its shape, at rest
  feed_stopped = 1u << 6,      ///< no more of the instrument is left to push in, or to draw back
  pulled_apart = 1u << 7,      ///< held ends pull a taut rod apart: their forces are those of no real rod
  joint_overturned = 1u << 8,  ///< two elements are at an angle near pi, where twist would slip: take shorter elements
};

struct RodReport {
  double push_N = 0;     ///< along the base's d3, what the fingers push the instrument with
  double torque_Nm = 0;  ///< about it, right-handed, what they turn it with
  /// What holds the base exerts on the rod; zero if nothing does. Without the inertia of the half element at the base.
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
  Eigen::Vector3d normal_W_N;    ///< force of the wall on the rod: pushing, and
  Eigen::Vector3d friction_W_N;  ///< rubbing
};

/// Where two rods touch, or one touches itself.
struct RodTouch {
  int rod = 0, node = 0;              ///< between this node and the next, and
  int other_rod = 0, other_node = 0;  ///< the same
  Eigen::Vector3d p_W;                ///< m
  Eigen::Vector3d force_W_N;          ///< on `rod`; the other feels the opposite
};

struct StepReport {
  std::vector<RodReport> rods;  ///< kept by the caller and reused; sized at the first step
  std::vector<Touch> touches;   ///< at walls, by rod and node
  std::vector<RodTouch> rod_touches;
  std::uint32_t trouble = 0;  ///< of all rods
};

}  // namespace ostium::core
