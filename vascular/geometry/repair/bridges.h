#pragma once
/// Where a lumen ends just before another one: the missing piece, from an end to a wall or from end to end, never from
/// side to side.
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

/// An end of a vessel.
struct VesselEnd {
  Eigen::Vector3d p, outwards;  ///< centre of the last sphere; unit
  double radius_m = 0;
  double widest_m = 0;  ///< largest radius just behind the end
  bool origin = false;  ///< may be the origin of its tree
};

std::vector<VesselEnd> ends_of(const Mesh& lumen);

struct Bridge {
  int from = 0, to = 0;          ///< indices of lumens
  Eigen::Vector3d p_from, p_to;  ///< centre of the end; the wall or end it is joined to
  double radius_m = 0;           ///< of the end
  double gap_m = 0;              ///< between the walls
  bool to_end = false;           ///< there is another end at p_to
  /// Unit vectors, out of the end and into the other lumen; the bridge bends from one to the other. Zero: straight.
  Eigen::Vector3d leaving = Eigen::Vector3d::Zero(), arriving = Eigen::Vector3d::Zero();
};

/// `lumens`: closed, largest first. A vessel is attached by its origin, its widest end; other ends, which may also come
/// close to each other, are left alone. At most one bridge between two lumens.
std::vector<Bridge> find_bridges(const std::vector<Mesh>& lumens, double longest_gap_m);

/// A closed tube without kinks that extends `reach_m` into both lumens.
Mesh body_of(const Bridge& bridge, double reach_m);

}  // namespace ostium::vascular
