#pragma once
#include "app/session/operator/setup.h"
#include "data/recording/recording.h"

namespace ostium::app {

/// What a recording says of itself. `operator_count`: numbers that the script's operator remembers. `shapes_Hz`: how
/// often nodes are recorded, to the nearest whole number of steps; 0: never.
data::RecordingHeader header_of(const SessionModel& model, const RunSetup& setup, std::size_t operator_count, bool full,
                                double shapes_Hz);

/// Numbers of all tools' nodes.
std::size_t shape_count(const SessionModel& model);
/// `row` has shape_count numbers, `inserted_m` one of each tool. The first node in the body is at the introducer,
/// however far from the tip that is; nodes before it are NaN. Does not allocate.
void put_shapes(const SessionModel& model, const SessionState& state, float* row, double* inserted_m);

}  // namespace ostium::app
