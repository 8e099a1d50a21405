#pragma once
/// The plots of explanation.html, each as SVG text.
#include "data/identification/selection/explanation.h"

namespace ostium::data {

/// Measured and modelled shapes, projected on two axes of the set's frame.
std::string shapes_plot(const MeasurementSet& set, const Explanation& x, int across);
/// For projections: what one view saw, and the modelled shapes as it sees them.
std::string view_plot(const MeasurementSet& set, const Explanation& x, int view);
/// For centrelines and polylines: root mean square residual against distance from the tip.
std::string along_wire_plot(const MeasurementSet& set, const Explanation& x);
/// For tips: residuals projected on two axes.
std::string tip_residual_plot(const MeasurementSet& set, const Explanation& x, int across);
/// For radii: measured and modelled, against time or experiment number.
std::string radius_plot(const MeasurementSet& set, const Explanation& x);
std::string experiments_plot(const MeasurementSet& set, const Explanation& x);

}  // namespace ostium::data
