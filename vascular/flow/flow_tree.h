#pragma once
/// The sphere tree as a network for flow and contrast: cells around spheres outside their parent's lumen, each branch's
/// in a row, parents before children; one per sphere at lesions, otherwise one per 0.7 mm.
#include <string>
#include <vector>

#include "vascular/heart/ecg.h"
#include "vascular/patient/patient.h"

namespace ostium::vascular {

struct FlowCell {
  int branch = 0;     ///< of FlowTree::branches
  int upstream = -1;  ///< cell; always less than its own index; -1: fed by the aortic root
  int sphere = 0;     ///< index in the tree's branch
  double length_m = 0;
  double s_m = 0;         ///< of its middle, from the branch's first sphere
  double healthy_m = 0;   ///< lumen radius without lesions
  double diseased_m = 0;  ///< with lesions; at most healthy_m
};

struct FlowBranch {
  std::string name;
  int first = 0, last = 0;  ///< cells [first, last)
  int parent = -1;          ///< branch; -1: leaves the aorta
  int parent_cell = -1;
  int tree_branch = 0;  ///< branch of the sphere tree
  Territory territory = Territory::lad;
  int tube = 0;       ///< tube of the anatomy
  double from_m = 0;  ///< arc length of its first cell along that tube
  int cells() const { return last - first; }
};

struct FlowTree {
  std::vector<FlowBranch> branches;
  std::vector<FlowCell> cells;
  /// Side branches that leave `cell`: branch indices sides[side_first[cell]] to sides[side_first[cell + 1] - 1].
  std::vector<int> side_first, sides;

  int branch(const std::string& name) const;  ///< -1 if there is none
  /// Cell at an arc length of a branch (as in Lesion::from_m), clamped to the branch.
  int cell_at(int branch, double from_branch_m) const;
  double s_of(int cell) const { return cells[static_cast<std::size_t>(cell)].s_m; }
  /// Cells from the ostium to `cell`, inclusive.
  std::vector<int> path_to(int cell) const;
  /// Whether blood from `upper` can reach `cell`.
  bool is_downstream(int cell, int upper) const;
};

/// The path from an ostium to a cell, for devices in it: cells, and the arc length of each cell's middle.
struct VesselPath {
  std::vector<int> cells;
  std::vector<double> s_m;
  double length_m() const { return s_m.back(); }
  /// The last cell whose middle is at or before s, and the share of the distance to the next; clamped to the path.
  struct Place {
    int index = 0;
    double share = 0;
  };
  Place at(double s_m) const;
  /// A per-cell quantity, interpolated linearly.
  double value(const std::vector<double>& of_cells, double s_m) const;
};
VesselPath path_along(const FlowTree& tree, int cell);
/// One path per branch, to its end.
std::vector<VesselPath> all_paths(const FlowTree& tree);
/// Whether two paths share the vessel at arc length s.
bool same_vessel(const VesselPath& a, const VesselPath& b, double s_m);
/// How far two paths are one: to the last cell that both have; below 0: not at all. 1 m if they are the same.
double common_m(const VesselPath& a, const VesselPath& b);
/// Arc length on the path of a position on a branch (as in Lesion::from_m). Throws std::invalid_argument if the path
/// does not go there.
double path_position(const FlowTree& tree, const VesselPath& path, const std::string& branch, double from_branch_m);

/// Flow tree of the coronary arteries. Branches of LM and LAD supply the LAD's territory; those of LCx and RCA their
/// own.
FlowTree flow_tree_of(const Patient& patient);

/// Straight tubes for tests: parent (-1: root), number of cells, cell length, radius; a side branch leaves its parent's
/// last cell.
struct PlainBranch {
  int parent = -1, cells = 1;
  double length_m = 0, radius_m = 0;
  Territory territory = Territory::lad;
};
FlowTree plain_tree(const std::vector<PlainBranch>& branches);

}  // namespace ostium::vascular
