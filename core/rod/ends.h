#pragma once
/// The ends of a rod: driven, held or free.
#include <cstdint>

#include "core/model/inputs.h"
#include "core/model/scratch.h"
#include "core/model/state.h"
#include "core/rod/elasticity.h"

namespace ostium::core {

/// `asked` with rates beyond tolerances.h reduced to the limit and non-finite values set to zero; adds to `trouble`
/// (bits of Trouble) what it changed.
RodInputs limited(const RodInputs& asked, std::uint32_t& trouble);

/// Which end frames are joined to a hold.
EndJoints joints_of(const RodInputs& inputs);

/// Records how the ends are held; true if this differs from the last step.
bool take_hold(const RodInputs& inputs, RodState& state);

/// Moves the poses of held ends by one step.
void drive_ends(const RodInputs& inputs, double step_s, RodState& state);

/// Holds the end nodes: removes held directions from chain.compliance and puts them into scratch.target.
void hold_ends(const Rod& rod, const RodInputs& inputs, const RodState& state, RodScratch& scratch);

/// Resets `state` to rest: no motion, held as in `inputs`.
void rest(const Rod& rod, const RodInputs& inputs, RodState& state);

/// Updates the poses of free ends from the rod; after the commit.
void follow_free_ends(const Rod& rod, const RodInputs& inputs, RodState& state);

}  // namespace ostium::core
