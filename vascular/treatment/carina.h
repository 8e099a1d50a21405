#pragma once
/// The carina of a fork, the edge between its two daughters, which balloons move.
///
/// A balloon that reaches from the parent into one daughter and is wider than that has its far wall where it was, and
/// pushes the edge aside by what it is wider,
///   x = 2 (b - r) cos(angle between the daughters)
/// into the other's mouth, whose short axis loses x while the long one stays. A balloon in the other pushes it back;
/// with one in each it lies where both push as far. It stays where it was left, as stent and wall hold it. Where a
/// stent holds the mouth, it does not narrow. [rule: carina shift in 39 of 40 crossed branches, PMID 23592548; the
/// factor is geometry, an estimate as a whole]
#include "vascular/contrast/lumen_map.h"
#include "vascular/flow/flow_tree.h"
#include "vascular/treatment/balloon.h"

namespace ostium::vascular {

/// One per side branch that leaves an artery before its end, or beside another at its end.
struct Fork {
  int main_cell = -1, side_cell = -1;  ///< the first of each daughter; the side branch is the smaller
  double cosine = 0.64;                ///< of the angle between them, at least 0 [50 degrees: diagonals, 45 to 55]
  double angle_rad = 0;                ///< where the side branch leaves, about the parent, from side to up (PathFrame)
};
std::vector<Fork> make_forks(const FlowTree& tree);
/// As they lie at end-diastole.
std::vector<Fork> make_forks(const FlowTree& tree, const LumenMap& map, const std::vector<VesselPath>& paths);

/// Radii of the balloons at both mouths of a fork; 0: none is there.
struct AtFork {
  double main_m = 0, side_m = 0;
};
/// How far a carina lies in the side branch's mouth, m; negative: in the main one's.
double shifted_carina_m(const FlowTree& tree, const Fork& fork, const AtFork& balloons, double was_m);
/// What is left of a mouth's radius, [0, 1]: as a circle of its area.
double mouth_left(double radius_m, double taken_m);

inline constexpr double mouth_m = 2e-3;  ///< length of a daughter that its mouth narrows, less and less

}  // namespace ostium::vascular
