#pragma once
/// The ends of a rod: driven by a hand, held, or free.
#include <cstdint>

#include "core/model/inputs.h"
#include "core/model/scratch.h"
#include "core/model/state.h"
#include "core/rod/elasticity.h"

namespace ostium::core {

/// `asked`, with rates beyond tolerances.h shortened to the limit and what is not finite taken as zero; adds what it
/// did to `trouble` (bits of Trouble).
RodInputs limited(const RodInputs& asked, std::uint32_t& trouble);

/// Whose frame the rod is joined to.
EndJoints joints_of(const RodInputs& inputs);

/// Notes how the ends are held; true if that is not how they were held in the last step.
bool take_hold(const RodInputs& inputs, RodState& state);

/// Moves the poses of held ends by one step.
void drive_ends(const RodInputs& inputs, double step_s, RodState& state);

/// Holds the end nodes: takes the held directions out of chain.compliance and puts them into scratch.target.
void hold_ends(const Rod& rod, const RodInputs& inputs, const RodState& state, RodScratch& scratch);

/// Makes `state` one that has been at rest: no motion, held as `inputs` say.
void rest(const Rod& rod, const RodInputs& inputs, RodState& state);

/// Lets the poses of free ends follow the rod; after the commit.
void follow_free_ends(const Rod& rod, const RodInputs& inputs, RodState& state);

}  // namespace ostium::core
