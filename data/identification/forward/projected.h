#pragma once
/// How a predicted shape is seen by the views of a set of projections.
#include "data/identification/effects/measured_view.h"
#include "data/identification/forward/shape.h"

namespace ostium::data {

/// The shape as one view sees it, pixels, base to tip.
std::vector<Eigen::Vector2d> projected_px(const PredictedShape& shape, const MeasuredView& view, int of_view);

/// Clicked minus model: for each clicked point, in the order of the polylines, its offset from the nearest point of
/// the model's projection in its view, which goes on straight past its ends. The offsets are perpendicular to the
/// projection, in pixels, and stand as vectors of the room in the plane of the detector (3 numbers).
Eigen::VectorXd projected_misfit(const Experiment& experiment, const PredictedShape& shape, const MeasuredView& view);

/// Points of all polylines.
std::size_t clicked_points(const Experiment& experiment);

}  // namespace ostium::data
