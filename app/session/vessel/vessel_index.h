#pragma once
/// The tree of a vessel as an instrument meets it: rooted at the access, with named places.
#include <string>
#include <utility>
#include <vector>

#include "vascular/geometry/centreline/sphere_tree.h"

namespace ostium::app {

class VesselIndex {
 public:
  /// `frames`: the same tree at evenly spaced phases of the beat, or a single one at rest. `named`: places besides the
  /// branches' own names, each at the sphere nearest to a point (m, at end-diastole). `breath`: [branch][sphere]
  /// displacement at full inspiration, m; empty: none.
  VesselIndex(std::vector<vascular::SphereTree> frames, const Eigen::Vector3d& p_access,
              const std::vector<std::pair<std::string, Eigen::Vector3d>>& named,
              std::vector<std::vector<Eigen::Vector3d>> breath = {});

  /// Index of the sphere that contains a point, or is nearest to it; `phase` in [0, 1), `breath` the depth of breath.
  /// Does not allocate.
  int locate(const Eigen::Vector3d& p, double phase, double breath = 0) const;
  /// Whether a point lies within the lumen of the branch that the sphere's branch leaves.
  bool in_parent(int sphere, const Eigen::Vector3d& p, double phase, double breath = 0) const;
  /// Whether `sphere` is `place` or lies beyond it, seen from the access.
  bool beyond(int sphere, int place) const;
  /// How far a sphere lies into side branches of this branch, measured from its centreline, m: 0 on it; -1: not beyond
  /// that branch's beginning.
  double astray_m(int sphere, int branch) const;
  /// Path length from the access, m.
  double from_access_m(int sphere) const { return nodes_[static_cast<std::size_t>(sphere)].from_access_m; }
  /// Path length from one sphere to another along the tree, m.
  double between_m(int a, int b) const;
  int branch(int sphere) const { return nodes_[static_cast<std::size_t>(sphere)].branch; }
  const std::vector<vascular::TreeBranch>& branches() const { return frames_.front().branches; }

  /// The sphere of a place: a name, a branch (where it leaves its parent), or a branch and millimetres, "RCA+20" beyond
  /// its origin, "D1-4" before the place where it leaves, along the vessel it leaves. -1: there is none.
  int place(const std::string& name) const;
  /// The sphere where a branch begins for an instrument coming from the access; -1: there is none.
  int entry(const std::string& branch) const;
  /// Where a branch leaves its parent: unit vectors along the parent (either sense) and, perpendicular to it, towards
  /// the branch.
  struct Departure {
    Eigen::Vector3d along = Eigen::Vector3d::Zero(), side = Eigen::Vector3d::Zero();  ///< zero: it has no parent
  };
  Departure departure(int sphere, double phase) const;  ///< of the sphere's branch
  int nearest(const Eigen::Vector3d& p) const;          ///< the sphere with the nearest centre, at end-diastole
  std::vector<std::string> places() const;              ///< names known to `place`
  Eigen::Vector3d p(int sphere, double phase) const;

 private:
  struct Node {
    int branch = 0, in_branch = 0;
    bool inside_parent = false;  ///< for a branch's first spheres within the parent's lumen
    double from_access_m = 0;
    int first = 0, last = 0;  ///< depth-first numbers: [first, last) are this sphere and all beyond
  };
  std::size_t frame_at(double phase) const;
  int place_beyond(int from, double by_m) const;
  int place_before(int entered, double by_m) const;  ///< `entered`: the entry of a branch
  /// Distance of a point from a sphere's surface in this frame's branches; negative within it.
  double apart_m(const Eigen::Vector3d& point, const std::vector<vascular::TreeBranch>& all, std::size_t branch,
                 std::size_t sphere, double breath) const;

  std::vector<vascular::SphereTree> frames_;
  std::vector<std::vector<Eigen::Vector3d>> breath_;
  std::vector<Node> nodes_;
  std::vector<int> offset_;  ///< index in nodes_ of each branch's first sphere
  std::vector<std::pair<std::string, int>> named_;
};

}  // namespace ostium::app
