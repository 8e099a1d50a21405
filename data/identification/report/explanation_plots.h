#pragma once
/// The plots of explanation.html, each as SVG text.
#include "data/identification/selection/explanation.h"

namespace ostium::data {

/// Measured and modelled shapes, seen along two axes of the set's frame.
std::string shapes_plot(const MeasurementSet& set, const Explanation& x, int across);
/// Of centrelines: the root mean square residual at each distance from the tip.
std::string along_wire_plot(const MeasurementSet& set, const Explanation& x);
/// Of tips: residuals seen along two axes.
std::string tip_residual_plot(const MeasurementSet& set, const Explanation& x, int across);
/// Of radii: measured and modelled, over time, or over the experiments in order.
std::string radius_plot(const MeasurementSet& set, const Explanation& x);
std::string experiments_plot(const MeasurementSet& set, const Explanation& x);

}  // namespace ostium::data
