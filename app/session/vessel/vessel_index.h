#pragma once
/// The tree of a vessel as an instrument meets it: rooted at the access, with names for places on it.
#include <string>
#include <utility>
#include <vector>

#include "vascular/geometry/centreline/sphere_tree.h"

namespace ostium::app {

class VesselIndex {
 public:
  /// `frames`: the same tree at evenly spaced phases of the beat, or one that stands still. `named`: places besides the
  /// branches' own names, each at the sphere nearest to a point (m, at end-diastole). `breath`: [branch][sphere] how
  /// far each is displaced at the top of a breath, m; empty: not at all.
  VesselIndex(std::vector<vascular::SphereTree> frames, const Eigen::Vector3d& p_access,
              std::vector<std::pair<std::string, Eigen::Vector3d>> named,
              std::vector<std::vector<Eigen::Vector3d>> breath = {});

  /// Number of the sphere that a point lies in, or nearest to; `phase` in [0, 1), `breath` its depth. Does not
  /// allocate.
  int locate(const Eigen::Vector3d& p, double phase, double breath = 0) const;
  /// Whether `sphere` is `place`, or lies beyond it as seen from the access.
  bool beyond(int sphere, int place) const;
  /// How far a sphere lies in branches that leave this one, from its middle line on, m: 0 on it; -1: it is not beyond
  /// that branch's beginning at all.
  double astray_m(int sphere, int branch) const;
  /// Length of the way from the access, m.
  double from_access_m(int sphere) const { return nodes_[static_cast<std::size_t>(sphere)].from_access_m; }
  int branch(int sphere) const { return nodes_[static_cast<std::size_t>(sphere)].branch; }
  const std::vector<vascular::TreeBranch>& branches() const { return frames_.front().branches; }

  /// The sphere of a place: a name, a branch (where it leaves its parent), or a branch and millimetres beyond that:
  /// "RCA+20". -1: there is none.
  int place(const std::string& name) const;
  /// Where a branch begins for an instrument that comes from the access; -1: there is none.
  int entry(const std::string& branch) const;
  /// Where a branch leaves its parent: the parent's direction there, either way, and, square to it, the side; unit.
  struct Departure {
    Eigen::Vector3d along = Eigen::Vector3d::Zero(), side = Eigen::Vector3d::Zero();  ///< zero: it has no parent
  };
  Departure departure(int sphere, double phase) const;  ///< of the branch that a sphere belongs to
  int nearest(const Eigen::Vector3d& p) const;          ///< the sphere with the nearest middle, at end-diastole
  std::vector<std::string> places() const;              ///< names that `place` knows
  Eigen::Vector3d p(int sphere, double phase) const;

 private:
  struct Node {
    int branch = 0, in_branch = 0;
    bool inside_parent = false;  ///< of the branch's first spheres, those within the parent's lumen
    double from_access_m = 0;
    int first = 0, last = 0;  ///< of the walk from the access: [first, last) are this one and all beyond
  };
  std::size_t frame_at(double phase) const;

  std::vector<vascular::SphereTree> frames_;
  std::vector<std::vector<Eigen::Vector3d>> breath_;
  std::vector<Node> nodes_;
  std::vector<int> offset_;  ///< of each branch's spheres among nodes_
  std::vector<std::pair<std::string, int>> named_;
};

}  // namespace ostium::app
