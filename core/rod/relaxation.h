#pragma once
/// The memory of a relaxing rod for the shapes it was held in; the law is in material/relaxing.h. Rods without
/// relaxation have no cost.
#include "core/rod/elasticity.h"

namespace ostium::core {

/// At the beginning of a step: gives `inside`'s law the creep of its joints.
void recall_creep(const Rod& rod, const RodState& state, Rod& inside);

/// At the end of a step: the branches creep towards the strain of the committed shape. The step is short compared with
/// their time constants, so the strain is taken as constant within it (exact for a shape that is held).
void creep(const Rod& inside, EndJoints ends, double step_s, RodState& state);

}  // namespace ostium::core
