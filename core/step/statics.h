#pragma once
/// Static equilibrium with the mechanics of `step`.
#include <cstdint>

#include "core/model/inputs.h"
#include "core/model/model.h"
#include "core/model/scratch.h"
#include "core/model/state.h"

namespace ostium::core {

struct RodEquilibrium {
  bool converged = false;
  int iterations = 0;
  double turn_rad = 0;  ///< largest turn of an element in the last iteration
  /// Independent motions that lower the energy: 0 for a stable equilibrium, 1 just above a buckling load.
  int negative_directions = 0;
  std::uint32_t trouble = 0;  ///< how the inputs were limited: bits of Trouble (report.h)
};

/// Puts each rod of `state` into the equilibrium that continues from its shape, at rest. Ends are held where `state`
/// has them, loads come from `inputs`; drive rates and drag have no effect.
///
/// Newton's method with a proximal term (like backward Euler with ever longer steps), so that it also converges from
/// afar, downhill, like a heavily damped motion. Does not allocate. Without convergence `state` is unchanged and the
/// report says so; non-finite values in `inputs` count as zero.
void find_equilibrium(const Model& model, const Inputs& inputs, State& state, Scratch& scratch,
                      std::vector<RodEquilibrium>& report);

/// Number of independent motions that would lower the energy of rod `r`, taking `state` as an equilibrium under
/// `inputs`. Internal forces are computed; the shape is not changed.
int negative_directions(const Model& model, const Inputs& inputs, const State& state, std::size_t r, Scratch& scratch);

}  // namespace ostium::core
