#pragma once
/// A vessel that was cut off before one of its branches leaves is extended past that branch's origin. (An aorta without
/// its root: the coronary arteries begin within the missing part.)
#include <optional>

#include "vascular/geometry/repair/bridges.h"

namespace ostium::vascular {

/// The end of a piece before its opening was closed.
struct CutEnd {
  std::vector<Eigen::Vector3d> rim;  ///< in order
  Eigen::Vector3d middle, outwards;  ///< outwards: unit
  double radius_m = 0;
};

/// Length, m, by which to extend `cut` past the origins among `branches` that lie ahead of it by at most
/// `longest_gap_m` and sideways by half that: as far as the valve is below a coronary artery. None: no branch begins
/// there.
std::optional<double> missing_length_m(const CutEnd& cut, const std::vector<VesselEnd>& branches, double longest_gap_m);

/// A straight extension of the rim, closed at both ends, starting `overlap_m` before the rim.
Mesh carried_on(const CutEnd& cut, double overlap_m, double length_m);

}  // namespace ostium::vascular
