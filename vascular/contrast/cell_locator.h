#pragma once
/// Where things lie in the coronary tree: from points in the patient frame (a rod's nodes, a marker, a tip) to cells,
/// paths and places, at a moment of the beat. Centres of cells are computed once a moment, then many points are asked
/// for.
#include <optional>

#include "vascular/contrast/lumen_map.h"

namespace ostium::vascular {

class CellLocator {
 public:
  /// Keeps references.
  CellLocator(const LumenMap& map, const FlowTree& tree);

  /// Cells move to where they are then; does not allocate after the first call.
  void set_moment(double phase, double breath_depth);

  struct Found {
    int cell = -1;          ///< -1: farther than the limit from every one
    double distance_m = 0;  ///< from its centre's piece of centreline
    double along_m = 0;     ///< from the cell's middle, distally
  };
  /// The nearest cell; `near` (a cell, or -1) is where to begin, for points in a row: then it costs next to nothing.
  Found nearest(const Eigen::Vector3d& p, double limit_m, int near = -1) const;
  /// The nearest of a path's cells.
  Found nearest_on(const VesselPath& path, const Eigen::Vector3d& p, double limit_m) const;
  const Eigen::Vector3d& centre(int cell) const { return centres_[static_cast<std::size_t>(cell)]; }

 private:
  Found measured(const Eigen::Vector3d& p, int cell) const;
  void measure_towards(const Eigen::Vector3d& p, int other, double sign, Found& best) const;
  const LumenMap& map_;
  const FlowTree& tree_;
  std::vector<Eigen::Vector3d> centres_;
  std::vector<int> child_first_, children_;
};

/// The cell whose vessel a point lies in. `wire_cell`: where the wire ends that what is asked for rides on, or -1; by a
/// fork it lies in the vessel that its wire goes down, however near the other one is.
CellLocator::Found inside(const CellLocator& locator, const FlowTree& tree, const std::vector<VesselPath>& paths,
                          const Eigen::Vector3d& p, int wire_cell);

/// Where a balloon or stent lies, from the middles of its two markers: the vessel that both are in, and how far along.
struct Seat {
  int branch = -1;      ///< along whose path both lie
  double middle_m = 0;  ///< between the markers, along that path
  double offset_m = 0;  ///< of the middle from the centreline
};
/// Empty if they are not both in one vessel of the tree (in a catheter outside the coronaries, say). `wire_cell` as
/// above.
std::optional<Seat> seat_of(const CellLocator& locator, const FlowTree& tree, const std::vector<VesselPath>& paths,
                            const Eigen::Vector3d& p_proximal_marker, const Eigen::Vector3d& p_distal_marker,
                            int wire_cell = -1);

/// What a shaft fills of the cells it lies in: raises `occupied_m` (#cells) to its radius there. `points`: along it.
void occupy(const CellLocator& locator, const FlowTree& tree, std::span<const Eigen::Vector3d> points, double radius_m,
            std::span<double> occupied_m);

/// Where an end hole is, for contrast and pressure: within a coronary, at an ostium (the nearer and the better aligned,
/// the more of a jet goes in), in the aorta, or elsewhere. `direction`: out of the hole, unit.
TipPlace tip_place(const CellLocator& locator, const FlowTree& tree, const ContrastModel& contrast,
                   const Patient& patient, const LumenMap& map, double phase, double breath,
                   const Eigen::Vector3d& p_tip, const Eigen::Vector3d& direction);

/// How far a point lies beyond the aortic valve's plane, towards the ventricle, m; negative: in the aorta. What is
/// beyond it touches the ventricle's wall (HeartInputs::irritation). What lies aside of the ventricle is not beyond.
double beyond_valve_m(const Landmarks& landmarks, const Eigen::Vector3d& p);

}  // namespace ostium::vascular
