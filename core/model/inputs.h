#pragma once
/// The only input to a running simulation: one struct per step, from a device, a script, a replay or a test.
#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/model/hold.h"
#include "core/wall/surface.h"

namespace ostium::core {

/// Motion of a held end. Given as rates, so that any command is continuous; beyond tolerances.h's limits they are
/// reduced to the limit, not-a-number counts as zero, and the step's report says so.
struct EndDrive {
  Hold hold = Hold::free;
  Eigen::Vector3d velocity_W_m_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d turn_rate_W_rad_s = Eigen::Vector3d::Zero();
};

/// Dead load on a stretch of a rod, spread evenly over its nodes there, such as an edge that catches a stent. Ignored
/// for nodes inside another rod.
struct StretchLoad {
  double from_tip_m = 0, to_tip_m = 0;  ///< nodes in between, or the one nearest to the middle
  Eigen::Vector3d force_W_N = Eigen::Vector3d::Zero();
};

/// A spring from a point of the rod to a point of the world, such as an open balloon to its shaft. Implicit, so it is
/// stable at any stiffness. Ignored for a point inside another rod.
struct Tether {
  double from_tip_m = 0;
  Eigen::Vector3d point_W = Eigen::Vector3d::Zero();
  Eigen::Vector3d along_W = Eigen::Vector3d::UnitZ();  ///< unit, towards the tip
  double along_N_m = 0, across_N_m = 0;                ///< stiffness; 0: none
};

inline constexpr int max_tethers = 3;  ///< of a rod

struct RodInputs {
  /// Speed at which the rod is pushed in at the introducer (the base's pose); negative: pulled back. Only a clamped
  /// base feeds.
  double feed_m_s = 0;
  EndDrive base{Hold::clamped};
  EndDrive tip{Hold::free};
  Eigen::Vector3d tip_force_W_N = Eigen::Vector3d::Zero();  ///< dead load on the distal tip
  StretchLoad load;
  std::array<Tether, max_tethers> tethers;
};

struct Inputs {
  std::vector<RodInputs> rods;          ///< one per rod of the model, in its order
  std::vector<SurfaceMotion> surfaces;  ///< per surface; missing ones stand still
};

}  // namespace ostium::core
