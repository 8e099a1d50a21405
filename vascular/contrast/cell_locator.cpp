#include "vascular/contrast/cell_locator.h"

#include <algorithm>
#include <cmath>

namespace ostium::vascular {

namespace {

constexpr double in_vessel = 1.6;     // distance from the centreline, in radii, that still counts as inside
constexpr double thrown_m = 1.5e-3;   // by which a beat throws a shaft out of its vessel
constexpr double at_ostium_m = 8e-3;  // distance from an ostium within which a jet may enter it
constexpr double in_aorta_m = 25e-3;
constexpr std::size_t boxed = 16;  // cells, which follow one another along a branch

}  // namespace

CellLocator::CellLocator(const LumenMap& map, const FlowTree& tree)
    : map_(map), tree_(tree), centres_(tree.cells.size()), boxes_((tree.cells.size() + boxed - 1) / boxed) {
  child_first_.assign(tree.cells.size() + 1, 0);
  for (const FlowCell& cell : tree.cells)
    if (cell.upstream >= 0) ++child_first_[cell.upstream + 1];
  for (std::size_t c = 1; c < child_first_.size(); ++c) child_first_[c] += child_first_[c - 1];
  children_.assign(child_first_.back(), -1);
  std::vector<int> next(child_first_.begin(), child_first_.end() - 1);
  for (std::size_t c = 0; c < tree.cells.size(); ++c)
    if (tree.cells[c].upstream >= 0) children_[next[tree.cells[c].upstream]++] = static_cast<int>(c);
}

void CellLocator::set_moment(const LumenMoment& moment) {
  for (Eigen::AlignedBox3d& box : boxes_) box.setEmpty();
  for (std::size_t c = 0; c < centres_.size(); ++c) {
    centres_[c] = map_.centre(c, moment);
    boxes_[c / boxed].extend(centres_[c]);
  }
}

void CellLocator::measure_towards(const Eigen::Vector3d& p, int other, double sign, Found& best) const {
  const Eigen::Vector3d &from = centres_[best.cell], d = centres_[other] - from;
  const double length = d.norm(), x = std::clamp((p - from).dot(d) / (length * length), 0.0, 0.5);
  const double distance = (p - from - x * d).norm();
  if (distance < best.distance_m) best.distance_m = distance, best.along_m = sign * x * length;
}

CellLocator::Found CellLocator::measured(const Eigen::Vector3d& p, int cell) const {
  // Compare with the centreline segments to both neighbours.
  Found best{cell, (p - centres_[cell]).norm(), 0};
  if (tree_.cells[cell].upstream >= 0) measure_towards(p, tree_.cells[cell].upstream, -1, best);
  for (int k = child_first_[cell]; k < child_first_[cell + 1]; ++k) measure_towards(p, children_[k], 1, best);
  return best;
}

CellLocator::Found CellLocator::nearest_on(const VesselPath& path, const Eigen::Vector3d& p, double limit_m) const {
  const auto at = std::min_element(path.cells.begin(), path.cells.end(), [&](int a, int b) {
    return (p - centres_[a]).squaredNorm() < (p - centres_[b]).squaredNorm();
  });
  Found best{*at, (p - centres_[*at]).norm(), 0};
  if (at != path.cells.begin()) measure_towards(p, at[-1], -1, best);
  if (at + 1 != path.cells.end()) measure_towards(p, at[1], 1, best);
  return best.distance_m <= limit_m ? best : Found{};
}

CellLocator::Found CellLocator::nearest(const Eigen::Vector3d& p, double limit_m, int near) const {
  int at = near;
  if (at < 0) {
    double least = limit_m * limit_m;
    for (std::size_t b = 0; b < boxes_.size(); ++b) {
      if (boxes_[b].squaredExteriorDistance(p) > least * (1 + 1e-9)) continue;
      for (std::size_t c = b * boxed; c < std::min(centres_.size(), (b + 1) * boxed); ++c)
        if (const double d = (p - centres_[c]).squaredNorm(); d < least) least = d, at = static_cast<int>(c);
    }
    if (at < 0) return {};
  }
  // Move to ever nearer neighbours.
  for (bool moved = true; moved;) {
    moved = false;
    double least = (p - centres_[at]).squaredNorm();
    const auto look = [&](int other) {
      if (other < 0) return;
      if (const double d = (p - centres_[other]).squaredNorm(); d < least) least = d, at = other, moved = true;
    };
    const int here = at;
    look(tree_.cells[here].upstream);
    for (int k = child_first_[here]; k < child_first_[here + 1]; ++k) look(children_[k]);
  }
  const Found found = measured(p, at);
  return found.distance_m <= limit_m ? found : Found{};
}

CellLocator::Found inside(const CellLocator& locator, const FlowTree& tree, const std::vector<VesselPath>& paths,
                          const Eigen::Vector3d& p, int wire_cell) {
  constexpr double limit_m = 10e-3;
  const auto is_inside = [&](const CellLocator::Found& f) {
    return f.cell >= 0 && f.distance_m <= in_vessel * tree.cells[f.cell].healthy_m;
  };
  // A beat throws it out of its vessel for a moment: it does not leave its wire for the vessel beside it.
  if (wire_cell >= 0)
    if (const auto f = locator.nearest_on(paths[tree.cells[wire_cell].branch], p, limit_m);
        f.cell >= 0 && f.distance_m <= in_vessel * tree.cells[f.cell].healthy_m + thrown_m)
      return f;
  const CellLocator::Found f = locator.nearest(p, limit_m);
  return is_inside(f) ? f : CellLocator::Found{};
}

std::optional<Seat> seat_of(const CellLocator& locator, const FlowTree& tree, const std::vector<VesselPath>& paths,
                            const Eigen::Vector3d& p_proximal_marker, const Eigen::Vector3d& p_distal_marker,
                            int wire_cell) {
  const CellLocator::Found near = inside(locator, tree, paths, p_proximal_marker, wire_cell),
                           far = inside(locator, tree, paths, p_distal_marker, wire_cell);
  if (near.cell < 0 || far.cell < 0 || !tree.is_downstream(far.cell, near.cell)) return {};
  Seat seat{.branch = tree.cells[far.cell].branch};
  const VesselPath& path = paths[seat.branch];
  const auto position = [&](const CellLocator::Found& f) {
    const auto at = std::find(path.cells.begin(), path.cells.end(), f.cell) - path.cells.begin();
    return path.s_m[static_cast<std::size_t>(at)] + f.along_m;
  };
  seat.middle_m = (position(near) + position(far)) / 2;
  seat.offset_m = (near.distance_m + far.distance_m) / 2;
  return seat;
}

void occupy(const CellLocator& locator, const FlowTree& tree, std::span<const Eigen::Vector3d> points, double radius_m,
            std::span<double> occupied_m) {
  int last = -1;
  for (const Eigen::Vector3d& p : points) {
    const CellLocator::Found f = locator.nearest(p, 6e-3, last);
    if (f.cell < 0 || f.distance_m > in_vessel * tree.cells[f.cell].healthy_m) {
      last = -1;
      continue;
    }
    // Also the cells between this point and the last one.
    const int low = last < 0 ? f.cell : std::min(last, f.cell), high = last < 0 ? f.cell : std::max(last, f.cell);
    if (last < 0 || tree.is_downstream(high, low))
      for (int c = high; c >= low && c >= 0; c = tree.cells[c].upstream)
        occupied_m[c] = std::max(occupied_m[c], radius_m);
    else
      occupied_m[f.cell] = std::max(occupied_m[f.cell], radius_m);
    last = f.cell;
  }
}

TipPlace tip_place(const CellLocator& locator, const FlowTree& tree, const ContrastModel& contrast,
                   const Patient& patient, const LumenMap& map, const LumenMoment& moment, const Eigen::Vector3d& p_tip,
                   const Eigen::Vector3d& direction) {
  const CellLocator::Found f = locator.nearest(p_tip, 6e-3);
  if (f.cell >= 0 && f.distance_m <= in_vessel * tree.cells[f.cell].healthy_m) {
    // Upstream of the first cell it is still in the sinus.
    const bool first = tree.cells[f.cell].upstream < 0;
    const Eigen::Vector3d into = first ? (locator.centre(f.cell + 1) - locator.centre(f.cell)).normalized() : direction;
    if (!first || (p_tip - locator.centre(f.cell)).dot(into) > -2e-3) return {TipPlace::coronary, f.cell, 1};
  }
  double nearest = at_ostium_m;
  TipPlace place;
  for (int side = 0; side < 2; ++side) {
    if (contrast.coronary_branch[side] < 0) continue;
    const int cell = tree.branches[contrast.coronary_branch[side]].first;
    const Eigen::Vector3d to = locator.centre(cell) - p_tip;
    const double distance = to.norm();
    if (distance >= nearest) continue;
    nearest = distance;
    const double aligned = std::max(0.0, direction.dot(to) / std::max(distance, 1e-6));
    place = {side ? TipPlace::right_sinus : TipPlace::left_sinus, 0, aligned * aligned * (1 - distance / at_ostium_m)};
  }
  if (place.where != TipPlace::outside) return place;
  double least = in_aorta_m;
  for (std::size_t i = 0; i < map.aorta.size(); ++i)
    if (const double d = (map.aorta_centre(i, moment) - p_tip).norm(); d < least)
      least = d, place = {TipPlace::aorta, static_cast<int>(i), 0};
  return beyond_valve_m(patient.anatomy.landmarks, p_tip) > 0 ? TipPlace{} : place;
}

constexpr double ventricle_radius_m = 0.02, ventricle_length_m = 0.09;  // rough size of its cavity below the valve

double beyond_valve_m(const Landmarks& landmarks, const Eigen::Vector3d& p) {
  const Eigen::Vector3d from = p - landmarks.p_annulus;
  const double beyond_m = -from.dot(landmarks.root_axis);
  // The valve's plane also cuts through arteries of leg and heart: what is far from the axis is not in the ventricle.
  const double aside_m = (from + beyond_m * landmarks.root_axis).norm();
  return beyond_m > 0 && (aside_m > ventricle_radius_m || beyond_m > ventricle_length_m) ? -aside_m : beyond_m;
}

}  // namespace ostium::vascular
