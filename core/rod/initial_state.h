#pragma once
/// States to begin from.
#include "core/model/state.h"

namespace ostium::core {

/// Rods straight from their base poses along d3 and at rest; `bases[i]` belongs to rod i, and so does `inserted_m[i]`,
/// the length beyond the base (whole rods if empty; below least_inserted_m of introducer.h: not in the body).
State make_state(const Model& model, const std::vector<EndState>& bases, const std::vector<double>& inserted_m = {});
/// The same with every rod in its unloaded shape.
State make_state_at_rest_shape(const Model& model, const std::vector<EndState>& bases,
                               const std::vector<double>& inserted_m = {});

}  // namespace ostium::core
