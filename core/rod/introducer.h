#pragma once
/// Feeding: a clamped base is an introducer through which an instrument is pushed and turned. The part outside is not
/// simulated.
///
/// The introducer stands still (or moves with the base) while material passes through it. The base element reaches from
/// there to its distal node, so its length keeps changing: between 0.4 of its own length and its own plus 0.6 of the
/// previous one's. Beyond these limits an element leaves or enters. Curvature, force and velocity at the base are
/// carried over, so that neither shape nor force jumps. One jump remains, because two chords of an arc are longer than
/// one; it goes into the base element's length as a slack of nanometres that fades within some 10 ms.
///
/// An instrument with fewer than three elements inside is not in the body: it is inactive, and its tip is within the
/// introducer. Fed further, it appears there in its unloaded shape. This is how instruments are exchanged.
#include <cstdint>

#include "core/model/inputs.h"
#include "core/model/rod.h"
#include "core/model/state.h"

namespace ostium::core {

/// Length of the three distal elements: with less than this inserted, a rod is not in the body.
double least_inserted_m(const Rod& rod);

/// Whether a rod is active.
bool in_body(const Rod& rod, const RodState& state);

/// The first element inside when `inserted_m` of an unfed rod is inserted; N: not in the body.
int first_element_for(const Rod& rod, double inserted_m);

/// Before a step that feeds: elements enter or leave while positions and length are consistent. Writes state.first and
/// slack_m, and these elements' fields; idempotent.
void renew_elements(const Rod& rod, const RodInputs& inputs, double step_s, RodState& state);

/// Feeds for one step: writes state.inserted_m, and the fields of a rod that appears. At either end of the instrument
/// it stops and sets `trouble`.
void feed(const Rod& rod, const RodInputs& inputs, double step_s, RodState& state, std::uint32_t& trouble);

/// Makes `inside` the part of `rod` that is inside the introducer according to `state`.
void cut_at_introducer(const Rod& rod, const RodState& state, Rod& inside);

/// Director d3 of an end's frame: the direction of advance.
Eigen::Vector3d axis(const EndState& end);

}  // namespace ostium::core
