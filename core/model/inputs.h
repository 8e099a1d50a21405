#pragma once
/// The only door into a running simulation: one struct a step, whoever fills it (device, script, replay, test).
#include <Eigen/Core>
#include <vector>

#include "core/model/hold.h"
#include "core/wall/surface.h"

namespace ostium::core {

/// What moves a held end. Rates, so that any command is continuous; beyond tolerances.h's limits they are shortened to
/// the limit, not-a-number counts as zero, and the step's report says so.
struct EndDrive {
  Hold hold = Hold::free;
  Eigen::Vector3d velocity_W_m_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d turn_rate_W_rad_s = Eigen::Vector3d::Zero();
};

/// Dead load on a stretch of a rod, spread evenly over its nodes there: an edge that its stent hangs on. Of nodes that
/// are inside another rod there is none.
struct StretchLoad {
  double from_tip_m = 0, to_tip_m = 0;  ///< nodes between them, or the one nearest to their middle
  Eigen::Vector3d force_W_N = Eigen::Vector3d::Zero();
};

/// A spring to a point of the world that holds a place of a rod along a direction, and lets it go across: the wall
/// round an open balloon. It pulls by where the step ends, so that it rings at no stiffness. Of a place that is inside
/// another rod there is none.
struct Tether {
  double from_tip_m = 0;
  Eigen::Vector3d point_W = Eigen::Vector3d::Zero();
  Eigen::Vector3d along_W = Eigen::Vector3d::UnitZ();  ///< unit, towards the tip
  double stiffness_N_m = 0;                            ///< 0: none
};

struct RodInputs {
  /// Length pushed in at the introducer, the base's pose, per time; negative: drawn back. Only a clamped base feeds.
  double feed_m_s = 0;
  EndDrive base{Hold::clamped};
  EndDrive tip{Hold::free};
  Eigen::Vector3d tip_force_W_N = Eigen::Vector3d::Zero();  ///< dead load on the distal tip
  StretchLoad load;
  Tether tether;
};

struct Inputs {
  std::vector<RodInputs> rods;          ///< one per rod of the model, in its order
  std::vector<SurfaceMotion> surfaces;  ///< of its surfaces; those that are missing stand still
};

}  // namespace ostium::core
