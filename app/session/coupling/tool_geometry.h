#pragma once
/// Points and directions of an instrument in the body, by distances from its tip.
#include "core/model/state.h"
#include "data/catalogue/instrument/instrument.h"

namespace ostium::app {

/// Direction of a rod's last two elements.
Eigen::Vector3d direction_at_tip(const core::Rod& rod, const core::RodState& state);
/// Distance of a marker's middle from the tip, m; `which`: 0 proximal, 1 distal.
double marker_from_tip_m(const data::Instrument& instrument, int which);
/// Point of a rod at that distance from its tip, m; the introducer if the point is outside the body.
Eigen::Vector3d point_from_tip(const core::Rod& rod, const core::RodState& state, double from_tip_m);

}  // namespace ostium::app
