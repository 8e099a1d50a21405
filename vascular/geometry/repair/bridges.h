#pragma once
/// Where a lumen ends a little before another one: the missing piece, from an end to a wall or from an end to an end,
/// never from side to side.
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

/// Where a vessel ends.
struct VesselEnd {
  Eigen::Vector3d p, outwards;  ///< middle of the last sphere; unit
  double radius_m = 0;
  double widest_m = 0;  ///< radius, just behind it
  bool origin = false;  ///< may be where its tree begins
};

std::vector<VesselEnd> ends_of(const Mesh& lumen);

struct Bridge {
  int from = 0, to = 0;          ///< lumens
  Eigen::Vector3d p_from, p_to;  ///< middle of the end; the wall or end that it is joined to
  double radius_m = 0;           ///< of the end
  double gap_m = 0;              ///< between the walls
  bool to_end = false;           ///< an end faces it there
  /// Unit, out of the end and into the other lumen: the way there bends from one to the other. Zero: straight.
  Eigen::Vector3d leaving = Eigen::Vector3d::Zero(), arriving = Eigen::Vector3d::Zero();
};

/// `lumens`: closed, the largest first. A vessel hangs by its origin, its widest end: others, which may come near each
/// other too, are left alone. Two lumens are bridged once at most.
std::vector<Bridge> find_bridges(const std::vector<Mesh>& lumens, double longest_gap_m);

/// A closed tube, without a kink, that reaches so far into both lumens.
Mesh body_of(const Bridge& bridge, double reach_m);

}  // namespace ostium::vascular
