#pragma once
/// Static equilibrium on the mechanics of `step`: what a rod comes to rest in.
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
  /// Independent motions that would lower the energy: 0 if the equilibrium is stable, 1 just behind a buckling load.
  int negative_directions = 0;
  std::uint32_t trouble = 0;  ///< what of the inputs was limited: bits of Trouble (step.h)
};

/// Puts each rod of `state` into the equilibrium that continues from its shape, at rest. Ends are held where `state`
/// has them, loads are those of `inputs`; drive rates and drag play no part.
///
/// Newton's method with a proximal term (as backward Euler would, with steps that grow without bound), so a far start
/// converges as well, downhill, like a heavily damped motion. Does not allocate. Where it does not converge, `state` is
/// untouched and the report says so; what is not finite in `inputs` counts as zero.
void find_equilibrium(const Model& model, const Inputs& inputs, State& state, Scratch& scratch,
                      std::vector<RodEquilibrium>& report);

/// Of rod `r` in `state`, which is taken to be an equilibrium under `inputs`: the number of independent motions that
/// would lower its energy. Internal forces are found, the shape is not touched.
int negative_directions(const Model& model, const Inputs& inputs, const State& state, std::size_t r, Scratch& scratch);

}  // namespace ostium::core
