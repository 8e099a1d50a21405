#include "data/catalogue/instrument/instrument_shape.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace ostium::data {

namespace {

constexpr double shortest_cut_m = 1e-9;  ///< ends of sections and pieces closer than this count as one

}  // namespace

double length_of(const std::vector<ShapePiece>& pieces) {
  double length = 0;
  for (const ShapePiece& piece : pieces) length += piece.length_m;
  return length;
}

Eigen::Vector3d rest_curvature(const ShapePiece& piece) {
  if (piece.radius_m == 0) return Eigen::Vector3d::Zero();
  return Eigen::Vector3d(-std::sin(piece.plane_rad), std::cos(piece.plane_rad), 0) / piece.radius_m;
}

std::vector<core::Section> bent(const std::vector<core::Section>& sections, const std::vector<ShapePiece>& pieces) {
  assert(!sections.empty() && length_of(pieces) <= sections.back().to_tip_m + shortest_cut_m);
  std::vector<core::Section> result;
  auto section = sections.begin();
  double reached = 0;
  for (const ShapePiece& piece : pieces) {
    const double piece_end = std::min(reached + piece.length_m, sections.back().to_tip_m);
    while (piece_end - reached > shortest_cut_m) {
      core::Section part = *section;
      part.from_tip_m = reached;
      if (part.to_tip_m > piece_end + shortest_cut_m) part.to_tip_m = piece_end;
      part.rest_curvature_per_m = rest_curvature(piece);
      result.push_back(part);
      reached = part.to_tip_m;
      if (section->to_tip_m <= reached + shortest_cut_m) ++section;
    }
  }
  for (; section != sections.end(); ++section) {
    result.push_back(*section);
    result.back().from_tip_m = std::max(section->from_tip_m, reached);
  }
  return result;
}

}  // namespace ostium::data
