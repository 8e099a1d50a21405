#pragma once
/// Locates things in the coronary tree: from points in the patient frame (a rod's nodes, a marker, a tip) to cells,
/// paths and positions, at a moment of the cardiac cycle. Cell centres are computed once per moment, for many queries.
#include <Eigen/Geometry>
#include <optional>

#include "vascular/contrast/lumen_map.h"

namespace ostium::vascular {

class CellLocator {
 public:
  /// Keeps references.
  CellLocator(const LumenMap& map, const FlowTree& tree);

  /// Moves the cells to that moment; does not allocate after the first call.
  void set_moment(const LumenMoment& moment);

  struct Found {
    int cell = -1;          ///< -1: farther than the limit from every cell
    double distance_m = 0;  ///< from the centreline segment at its centre
    double along_m = 0;     ///< from the cell's middle, distally
  };
  /// The nearest cell; `near` (a cell, or -1) is the starting guess, which makes a series of neighbouring points very
  /// cheap.
  Found nearest(const Eigen::Vector3d& p, double limit_m, int near = -1) const;
  /// The nearest cell of a path.
  Found nearest_on(const VesselPath& path, const Eigen::Vector3d& p, double limit_m) const;
  const Eigen::Vector3d& centre(int cell) const { return centres_[static_cast<std::size_t>(cell)]; }

 private:
  Found measured(const Eigen::Vector3d& p, int cell) const;
  void measure_towards(const Eigen::Vector3d& p, int other, double sign, Found& best) const;
  const LumenMap& map_;
  const FlowTree& tree_;
  std::vector<Eigen::Vector3d> centres_;
  std::vector<Eigen::AlignedBox3d> boxes_;  ///< of `boxed` cells each, one after the other
  std::vector<int> child_first_, children_;
};

/// The cell whose vessel contains a point. `wire_cell`: cell of the tip of the wire that the device rides on, or -1;
/// near a bifurcation, the point is in the vessel that the wire follows, even if the other is nearer.
CellLocator::Found inside(const CellLocator& locator, const FlowTree& tree, const std::vector<VesselPath>& paths,
                          const Eigen::Vector3d& p, int wire_cell);

/// Seat of a balloon or stent, from the middles of its two markers: the vessel that contains both, and the position
/// along it.
struct Seat {
  int branch = -1;      ///< branch whose path contains both
  double middle_m = 0;  ///< midpoint of the markers along that path
  double offset_m = 0;  ///< of the midpoint from the centreline
};
/// Empty unless both are in one vessel of the tree (e.g. in a catheter outside the coronaries). `wire_cell` as above.
std::optional<Seat> seat_of(const CellLocator& locator, const FlowTree& tree, const std::vector<VesselPath>& paths,
                            const Eigen::Vector3d& p_proximal_marker, const Eigen::Vector3d& p_distal_marker,
                            int wire_cell = -1);

/// Marks the cells occupied by a shaft: raises `occupied_m` (#cells) to its radius there. `points`: along the shaft.
void occupy(const CellLocator& locator, const FlowTree& tree, std::span<const Eigen::Vector3d> points, double radius_m,
            std::span<double> occupied_m);

/// Location of an end hole for contrast and pressure: in a coronary, at an ostium (the closer and better aligned, the
/// more of a jet enters it), in the aorta, or elsewhere. `direction`: out of the hole, unit.
TipPlace tip_place(const CellLocator& locator, const FlowTree& tree, const ContrastModel& contrast,
                   const Patient& patient, const LumenMap& map, const LumenMoment& moment, const Eigen::Vector3d& p_tip,
                   const Eigen::Vector3d& direction);

/// Distance of a point beyond the aortic valve's plane, towards the ventricle, m; negative: in the aorta. Beyond it the
/// ventricle's wall is touched (HeartInputs::irritation). Points beside the ventricle are not beyond.
double beyond_valve_m(const Landmarks& landmarks, const Eigen::Vector3d& p);

}  // namespace ostium::vascular
