#pragma once
/// The sphere tree as a network: cells about spheres that lie outside of their parent's lumen, each branch's in a row,
/// parents before children; every sphere where lesions are, else one in 0.7 mm. Flow and contrast go along it.
#include <string>
#include <vector>

#include "vascular/heart/ecg.h"
#include "vascular/patient/patient.h"

namespace ostium::vascular {

struct FlowCell {
  int branch = 0;     ///< of FlowTree::branches
  int upstream = -1;  ///< cell; always less than its own; -1: fed by the aortic root
  int sphere = 0;     ///< of the tree's branch
  double length_m = 0;
  double s_m = 0;         ///< of its middle, from the sphere branch's first sphere
  double healthy_m = 0;   ///< radius of the lumen without lesions
  double diseased_m = 0;  ///< and with them: at least as small
};

struct FlowBranch {
  std::string name;
  int first = 0, last = 0;  ///< cells [first, last)
  int parent = -1;          ///< branch; -1: it springs from the aorta
  int parent_cell = -1;
  int tree_branch = 0;  ///< of the sphere tree
  Territory territory = Territory::lad;
  int tube = 0;       ///< of the anatomy
  double from_m = 0;  ///< arc length along that tube, of its first cell
  int cells() const { return last - first; }
};

struct FlowTree {
  std::vector<FlowBranch> branches;
  std::vector<FlowCell> cells;
  /// Cells that leave `cell`, a side branch each: [side_first[cell], side_first[cell + 1]) of `sides`, branch indices.
  std::vector<int> side_first, sides;

  int branch(const std::string& name) const;  ///< -1 if there is none
  /// Cell of a branch's arc length (as Lesion::from_m counts it), limited to the branch.
  int cell_at(int branch, double from_branch_m) const;
  double s_of(int cell) const { return cells[static_cast<std::size_t>(cell)].s_m; }
  /// Cells from the ostium to `cell`, it included.
  std::vector<int> path_to(int cell) const;
  /// Whether blood that leaves `upper` may reach `cell`.
  bool is_downstream(int cell, int upper) const;
};

/// The way from an ostium to a cell, for what lies in it: cells, and how far along the way each one's middle is.
struct VesselPath {
  std::vector<int> cells;
  std::vector<double> s_m;
  double length_m() const { return s_m.back(); }
  /// The last cell whose middle is not beyond s, and how far s is on the way to the next; limited to the path.
  struct Place {
    int index = 0;
    double share = 0;
  };
  Place at(double s_m) const;
  /// A number of the cells, linear between them.
  double value(const std::vector<double>& of_cells, double s_m) const;
};
VesselPath path_along(const FlowTree& tree, int cell);
/// To the end of each branch.
std::vector<VesselPath> all_paths(const FlowTree& tree);
/// Whether two paths are one and the same at a place, so that what lies there lies in both.
bool same_vessel(const VesselPath& a, const VesselPath& b, double s_m);
/// Where on the path a place of a branch is, as Lesion::from_m counts it. Throws std::invalid_argument if the path does
/// not go there.
double path_position(const FlowTree& tree, const VesselPath& path, const std::string& branch, double from_branch_m);

/// Of the coronary arteries. Those that spring from LM or LAD serve the LAD's muscle, from LCx its own; from RCA its.
FlowTree flow_tree_of(const Patient& patient);

/// Straight tubes for tests: each row is parent (-1: root), cells, length of each, and radius; a side branch leaves its
/// parent's last cell.
struct PlainBranch {
  int parent = -1, cells = 1;
  double length_m = 0, radius_m = 0;
  Territory territory = Territory::lad;
};
FlowTree plain_tree(const std::vector<PlainBranch>& branches);

}  // namespace ostium::vascular
