#pragma once
/// The measured points of an experiment as curves along the wire.
#include "data/identification/measurement/measurement_set.h"

namespace ostium::data {

/// Points that follow each other from base to tip: a centreline, or the polyline of one view.
struct MeasuredCurve {
  std::size_t first = 0;           ///< index of its first point among all points of the experiment
  int view = 0;                    ///< of the set's views
  std::vector<double> from_tip_m;  ///< of each point along the wire; for polylines by their share of the length seen
};

/// None for tips and radii.
std::vector<MeasuredCurve> measured_curves(const Experiment& experiment);

}  // namespace ostium::data
