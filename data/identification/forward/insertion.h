#pragma once
/// Sets in a vessel: the whole history of insertions, run with contact and friction, since what a wall holds back
/// depends on the way there.
///
/// Instruments are the rods of `core`, bound to one another where they are nested, fed and turned from the base at the
/// same slow speed in all experiments, in listed order, the first from outside; drag holds motion down, so that what is
/// recorded after a rest is a shape in balance with walls and friction. Every experiment has the first one's base.
#include "data/identification/forward/shape.h"

namespace ostium::data {

/// One shape per experiment. Where the run goes wrong, that shape and those after it have not converged. `progress` may
/// be empty. Throws std::invalid_argument if changed numbers make no rod.
std::vector<PredictedShape> insert(const MeasurementSet& set, const Changes& changes,
                                   const std::function<void(std::size_t, std::size_t)>& progress = {});

}  // namespace ostium::data
