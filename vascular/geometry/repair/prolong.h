#pragma once
/// A vessel that was cut off before a branch leaves it: its end is carried on past the branch's origin. (An aorta
/// without its root: the coronary arteries begin beyond its end, within what is missing.)
#include <optional>

#include "vascular/geometry/repair/bridges.h"

namespace ostium::vascular {

/// Where a piece ended before its opening was closed.
struct CutEnd {
  std::vector<Eigen::Vector3d> rim;  ///< in order
  Eigen::Vector3d middle, outwards;  ///< outwards: unit
  double radius_m = 0;
};

/// How far `cut` has to be carried on, m, past the origins among `branches` that lie ahead of it, at most
/// `longest_gap_m`, and beside it by half of that: as far as the valve is below a coronary artery. None: nothing begins
/// there.
std::optional<double> missing_length_m(const CutEnd& cut, const std::vector<VesselEnd>& branches, double longest_gap_m);

/// The rim carried on straight, closed at both ends; begins `overlap_m` before the rim.
Mesh carried_on(const CutEnd& cut, double overlap_m, double length_m);

}  // namespace ostium::vascular
