#pragma once
/// Unnamed fields that could remove a residual, whatever its cause. For the fit each is an effect with many numbers and
/// a prior that keeps them small; none is in the list of effects.
#include "data/identification/effects/effect.h"

namespace ostium::data {

inline constexpr int field_knots = 10;

/// Rest curvature in the material frame, linear between knots from the innermost tip to the longest insertion.
const Effect& rest_curvature_field();
/// Force per length in the set's frame, linear between the same knots.
const Effect& lateral_force_field();
/// Rigid and affine imaging errors.
const Effect& image_field();
/// Drift of frame, curvature and stiffness with time in position, or with the order of the experiments.
const Effect& time_field();

/// Position of a knot, m from the tip.
double field_knot(const MeasurementSet& set, int knot);

}  // namespace ostium::data
