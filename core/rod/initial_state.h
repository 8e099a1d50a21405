#pragma once
/// Initial states.
#include "core/model/state.h"

namespace ostium::core {

/// Straight rods along d3 from their base poses, at rest; `bases[i]` and `inserted_m[i]` belong to rod i, the latter
/// being the length beyond the base (whole rods if empty; below least_inserted_m of introducer.h: not in the body).
State make_state(const Model& model, const std::vector<EndState>& bases, const std::vector<double>& inserted_m = {});
/// The same with every rod in its unloaded shape.
State make_state_at_rest_shape(const Model& model, const std::vector<EndState>& bases,
                               const std::vector<double>& inserted_m = {});

}  // namespace ostium::core
