#include "vascular/flow/flow_tree.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>

#include "vascular/flow/coronary_roots.h"

namespace ostium::vascular {

namespace {

constexpr double spacing_m = 0.7e-3;  // cell length away from lesions

/// Lists the side branches, sorted by the cell they leave.
void list_sides(FlowTree& tree) {
  tree.side_first.assign(tree.cells.size() + 1, 0);
  for (const FlowBranch& b : tree.branches)
    if (b.parent_cell >= 0 && tree.cells[b.parent_cell].branch == b.parent) ++tree.side_first[b.parent_cell + 1];
  for (std::size_t i = 1; i < tree.side_first.size(); ++i) tree.side_first[i] += tree.side_first[i - 1];
  tree.sides.assign(tree.side_first.back(), -1);
  std::vector<int> next(tree.side_first.begin(), tree.side_first.end() - 1);
  for (std::size_t b = 0; b < tree.branches.size(); ++b)
    if (tree.branches[b].parent_cell >= 0) tree.sides[next[tree.branches[b].parent_cell]++] = static_cast<int>(b);
}

Territory territory_of(const std::string& name, const FlowTree& tree, int parent) {
  if (name == "LM" || name == "LAD") return Territory::lad;
  if (name == "LCx") return Territory::lcx;
  if (name == "RCA") return Territory::rca;
  return parent >= 0 ? tree.branches[parent].territory : Territory::lad;
}

}  // namespace

int FlowTree::branch(const std::string& name) const {
  for (std::size_t b = 0; b < branches.size(); ++b)
    if (branches[b].name == name) return static_cast<int>(b);
  return -1;
}

int FlowTree::cell_at(int branch, double from_branch_m) const {
  const FlowBranch& b = branches[branch];
  int cell = b.first;
  while (cell + 1 < b.last && cells[cell + 1].s_m - cells[cell + 1].length_m / 2 <= from_branch_m) ++cell;
  return cell;
}

std::vector<int> FlowTree::path_to(int cell) const {
  std::vector<int> path;
  for (int c = cell; c >= 0; c = cells[c].upstream) path.push_back(c);
  std::reverse(path.begin(), path.end());
  return path;
}

bool FlowTree::is_downstream(int cell, int upper) const {
  while (cell > upper) cell = cells[cell].upstream;
  return cell == upper;
}

VesselPath path_along(const FlowTree& tree, int cell) {
  VesselPath path{.cells = tree.path_to(cell), .s_m = {}};
  for (std::size_t i = 0; i < path.cells.size(); ++i) {
    const double own = tree.cells[path.cells[i]].length_m / 2;
    path.s_m.push_back(i ? path.s_m.back() + tree.cells[path.cells[i - 1]].length_m / 2 + own : own);
  }
  return path;
}

std::vector<VesselPath> all_paths(const FlowTree& tree) {
  std::vector<VesselPath> paths;
  for (const FlowBranch& b : tree.branches) paths.push_back(path_along(tree, b.last - 1));
  return paths;
}

bool same_vessel(const VesselPath& a, const VesselPath& b, double s_m) {
  const auto i = static_cast<std::size_t>(a.at(s_m).index);
  return i < b.cells.size() && a.cells[i] == b.cells[i];
}

double common_m(const VesselPath& a, const VesselPath& b) {
  const std::size_t most = std::min(a.cells.size(), b.cells.size());
  const auto parts =
      std::mismatch(a.cells.begin(), a.cells.begin() + static_cast<std::ptrdiff_t>(most), b.cells.begin());
  const auto same = static_cast<std::size_t>(parts.first - a.cells.begin());
  if (same == 0) return -1;
  return same == a.cells.size() && same == b.cells.size() ? 1 : a.s_m[same - 1];
}

VesselPath::Place VesselPath::at(double s) const {
  const auto above = std::upper_bound(s_m.begin(), s_m.end(), s) - s_m.begin();
  if (above == 0) return {0, 0};
  const auto i = static_cast<std::size_t>(above) - 1;
  if (i + 1 == s_m.size()) return {static_cast<int>(i), 0};
  return {static_cast<int>(i), (s - s_m[i]) / (s_m[i + 1] - s_m[i])};
}

double VesselPath::value(const std::vector<double>& of_cells, double s) const {
  const Place p = at(s);
  const double a = of_cells[cells[p.index]];
  return p.share > 0 ? (1 - p.share) * a + p.share * of_cells[cells[p.index + 1]] : a;
}

double path_position(const FlowTree& tree, const VesselPath& path, const std::string& branch, double from_branch_m) {
  const int b = tree.branch(branch);
  for (std::size_t i = 0; b >= 0 && i < path.cells.size(); ++i)
    if (const FlowCell& cell = tree.cells[path.cells[i]]; cell.branch == b)
      return path.s_m[i] + from_branch_m - cell.s_m;
  throw std::invalid_argument("the path does not go through " + branch);
}

FlowTree flow_tree_of(const Patient& patient) {
  const Anatomy& anatomy = patient.anatomy;
  const SphereTree& spheres = patient.tree;
  FlowTree tree;
  std::vector<int> flow_branch(spheres.branches.size(), -1);
  std::vector<std::vector<int>> cell_of(spheres.branches.size());
  for (std::size_t t = 0; t < spheres.branches.size(); ++t) {
    const TreeBranch& from = spheres.branches[t];
    const NamedBranch& named = anatomy.branches[t];
    const bool root = is_coronary_root(from.name);
    if (!root && (from.parent < 0 || flow_branch[from.parent] < 0)) continue;
    FlowBranch b{.name = from.name,
                 .first = static_cast<int>(tree.cells.size()),
                 .tree_branch = static_cast<int>(t),
                 .tube = named.tube};
    // The second half of a trunk begins where the first ends; other branches where they leave their parent's lumen.
    const bool goes_on = !root && anatomy.branches[t - 1].tube == named.tube;
    if (!root) b.parent = flow_branch[from.parent];
    const double begins = goes_on ? 0 : named.from_m;
    std::vector<int>& own = cell_of[t];
    own.assign(from.spheres.size(), -1);
    const double along = goes_on ? named.from_m : 0;
    for (std::size_t i = 0; i < from.spheres.size(); ++i) {
      const TreeSphere& sphere = from.spheres[i];
      const bool first = tree.cells.size() == static_cast<std::size_t>(b.first), last = i + 1 == from.spheres.size();
      if (sphere.s_m < begins && i + 2 < from.spheres.size()) continue;
      const double scale = narrowing_at(anatomy, patient.lesions, named.tube, along + sphere.s_m).scale;
      if (!first && !last && scale == 1 && sphere.s_m - begins - tree.cells.back().s_m < spacing_m) continue;
      FlowCell cell{.branch = static_cast<int>(tree.branches.size()), .sphere = static_cast<int>(i)};
      cell.s_m = sphere.s_m - begins;
      // The tube's own radius: near a narrowing, spheres are limited by its shoulder.
      cell.healthy_m = anatomy.tubes[named.tube].at(along + sphere.s_m).radius_m;
      cell.diseased_m = scale * cell.healthy_m;
      if (!first)
        cell.upstream = static_cast<int>(tree.cells.size()) - 1;
      else if (!root)
        cell.upstream = cell_of[from.parent][from.parent_sphere];
      tree.cells.push_back(cell);
      own[i] = static_cast<int>(tree.cells.size()) - 1;
    }
    // Spheres between cells, and those inside the parent's lumen, belong to the next distal cell.
    for (int i = static_cast<int>(own.size()) - 2; i >= 0; --i)
      if (own[i] < 0) own[i] = own[i + 1];
    b.last = static_cast<int>(tree.cells.size());
    for (int c = b.first; c < b.last; ++c) {
      // From midpoint to midpoint of its neighbours.
      const double below = c > b.first ? tree.cells[c].s_m - tree.cells[c - 1].s_m : 0;
      const double above = c + 1 < b.last ? tree.cells[c + 1].s_m - tree.cells[c].s_m : 0;
      tree.cells[c].length_m = (below + above) / 2;
    }
    b.parent_cell = tree.cells[b.first].upstream;
    b.from_m = along + from.spheres[tree.cells[b.first].sphere].s_m;
    b.territory = territory_of(b.name, tree, b.parent);
    flow_branch[t] = static_cast<int>(tree.branches.size());
    tree.branches.push_back(b);
  }
  list_sides(tree);
  return tree;
}

FlowTree plain_tree(const std::vector<PlainBranch>& branches) {
  FlowTree tree;
  for (const PlainBranch& plain : branches) {
    FlowBranch b{.name = "branch " + std::to_string(tree.branches.size()),
                 .first = static_cast<int>(tree.cells.size()),
                 .parent = plain.parent,
                 .territory = plain.territory};
    b.parent_cell = plain.parent < 0 ? -1 : tree.branches[plain.parent].last - 1;
    for (int i = 0; i < plain.cells; ++i)
      tree.cells.push_back({.branch = static_cast<int>(tree.branches.size()),
                            .upstream = i ? b.first + i - 1 : b.parent_cell,
                            .length_m = plain.length_m,
                            .s_m = (i + 0.5) * plain.length_m,
                            .healthy_m = plain.radius_m,
                            .diseased_m = plain.radius_m});
    b.last = static_cast<int>(tree.cells.size());
    tree.branches.push_back(b);
  }
  list_sides(tree);
  return tree;
}

}  // namespace ostium::vascular
