#pragma once
/// One step of the simulation.
#include "core/model/inputs.h"
#include "core/model/model.h"
#include "core/model/report.h"
#include "core/model/scratch.h"
#include "core/model/state.h"

namespace ostium::core {

/// Advances `state` by model.step_s.
///
/// Second-order backward differences (BDF2) in the positions, first-order in the tiny rotary inertia. Positions, frames
/// and internal forces are solved together, implicitly, by Newton's method, starting from extrapolated frames (usually
/// one iteration). Cost is linear in the number of elements.
///
/// `inputs.rods`, `state.rods` and `scratch` must fit the model (asserted). Never throws; does not allocate after the
/// first call with the same `report`. Bit-identical for the same arguments, whatever `scratch` held. Different states
/// may be stepped by different threads at once.
void step(const Model& model, const Inputs& inputs, State& state, Scratch& scratch, StepReport& report);

}  // namespace ostium::core
