#pragma once
/// Energy of a rod; for tests and reports, not part of a step.
#include "core/model/inputs.h"
#include "core/model/model.h"
#include "core/model/state.h"

namespace ostium::core {

struct Energy {
  double elastic_J = 0;  ///< of bending and twist, over all joints and the ends that are held
  double kinetic_J = 0;  ///< of the nodes
  double weight_J = 0;   ///< against gravity, from the world's origin

  double total_J() const { return elastic_J + kinetic_J + weight_J; }
};

/// Energy of rod `r`. `inputs` say how its ends are held. The part outside the introducer does not count.
Energy energy(const Model& model, const Inputs& inputs, const State& state, std::size_t r);

}  // namespace ostium::core
