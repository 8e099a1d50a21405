#pragma once
/// What a rod remembers of the shapes it was held in; the law is in relaxing.h. Rods without a relaxation pay nothing.
#include "core/rod/elasticity.h"

namespace ostium::core {

/// At the beginning of a step: gives `inside`'s law what its joints have crept by.
void recall_creep(const Rod& rod, const RodState& state, Rod& inside);

/// At the end of a step: the branches creep towards the strain of the committed shape. The step is short against their
/// times, so within it the strain is taken as constant (exact for a shape that is held).
void creep(const Rod& inside, EndJoints ends, double step_s, RodState& state);

}  // namespace ostium::core
