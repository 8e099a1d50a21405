#pragma once
/// Whether a clicked polyline can be what it says: in the picture, in pixels, from base to tip, no longer than the
/// wire.
#include "data/identification/measurement/measurement_set.h"

namespace ostium::data {

/// "" if it can; else what is wrong and what to look at, without its place. `point`: the one that is wrong, if it is
/// one.
std::string doubt_of(const MeasuredCArm& view, const Experiment& experiment, const ClickedPolyline& polyline,
                     std::optional<std::size_t>& point);

}  // namespace ostium::data
