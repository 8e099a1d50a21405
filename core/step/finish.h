#pragma once
/// The end of a step: iterates become the state, forces and touches the report.
#include "core/base/tolerances.h"
#include "core/model/model.h"
#include "core/model/report.h"
#include "core/model/scratch.h"
#include "core/model/state.h"

namespace ostium::core {

/// Whether an iterate may become the state: its elements have kept their lengths.
inline bool usable(const RodScratch& s) {
  return s.progress != Progress::failed && s.defect <= tolerances::usable_stretch;
}

/// Writes the solution into the state. `halved`: of a part of the step, since the whole had none.
void finish_all(const Model& model, bool halved, State& state, Scratch& scratch, StepReport& report);

}  // namespace ostium::core
