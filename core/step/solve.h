#pragma once
/// One Newton iteration of all strands. Internal to the step.
#include "core/model/model.h"
#include "core/model/report.h"
#include "core/model/scratch.h"

namespace ostium::core {

/// Whether the strand begins at another one's tip and is solved with it.
inline bool is_branch(const Strand& strand) { return strand.nest && strand.nest->trunk; }

/// Solves strands that have not converged, each with its branches, until their ties to walls are those that push.
void solve_open(const Model& model, Scratch& scratch);

/// Applies the solution to a strand and its branches, and says whether they have converged.
void take_solution(Tree tree, RodReport& report, StepCounts& counts);

}  // namespace ostium::core
