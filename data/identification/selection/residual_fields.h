#pragma once
/// Fields without a name: what could remove a residual, whatever its cause. Each is an effect to the fit, with many
/// numbers and a prior that holds them small, and none is in the list of effects.
#include "data/identification/effects/effect.h"

namespace ostium::data {

inline constexpr int field_knots = 10;

/// Rest curvature in the material frame, linear between knots from the innermost tip to the longest insertion.
const Effect& rest_curvature_field();
/// Force per length in the frame of the set, linear between the same knots.
const Effect& lateral_force_field();
/// Rigid and affine errors of the picture.
const Effect& image_field();
/// A frame, a curvature and a stiffness that drift with the time in position, or with the order of the experiments.
const Effect& time_field();

/// Knots, m from the tip.
double field_knot(const MeasurementSet& set, int knot);

}  // namespace ostium::data
