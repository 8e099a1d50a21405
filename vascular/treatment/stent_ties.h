#pragma once
/// Attaches the points of deployed stents to the wall, with which they move from then on.
///
/// A point is tied to the nearest triangle of the lumen around the cells of its path beside it, so that no strut is
/// tied to another branch that happens to pass. One ring takes a few tenths of a millisecond: a session ties one a
/// step.
#include "vascular/treatment/stent_shape.h"

namespace ostium::vascular {

class StentTies {
 public:
  /// Keeps references.
  StentTies(const Patient& patient, const WallShape& shape, const LumenMap& map, const FlowTree& tree);

  /// Ties the next ring of a deployed stent, or one whose points have moved along the wall since, to the wall, both in
  /// their present shape. False if every ring is tied where it is. Does not allocate.
  bool tie_next(const StentModel& model, const VesselPath& path, const PlaqueState& wall, const LumenMoment& moment,
                StentState& state) const;

 private:
  const Patient& patient_;
  const WallShape& shape_;
  const LumenMap& map_;
  std::vector<int> first_, triangles_;  ///< around a cell: triangles_[first_[cell], first_[cell + 1])
};

/// Ties all rings at once; those tied before, too.
void tie_to_wall(const StentTies& ties, const StentModel& model, const VesselPath& path, const PlaqueState& wall,
                 const LumenMoment& moment, StentState& state);

}  // namespace ostium::vascular
