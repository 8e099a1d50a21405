#pragma once
/// Feeding: a clamped base is an introducer that an instrument is pushed and turned through. What is still outside is
/// not simulated.
///
/// The introducer stands still (or moves as the base does); material passes it. The base element reaches from there to
/// its distal node, so its length changes all the time: between 0.4 of its own length and its own plus 0.6 of the one
/// before. Beyond that an element enters or leaves. Curvature, force and velocity at the base are carried over, so that
/// neither shape nor force jumps; the last cause of a jump, that two chords of an arc are longer than one, is put into
/// the base element's length as a slack of nanometres, which fades within some 10 ms.
///
/// An instrument of which less than three elements are inside is not in the body: it takes part in nothing, and its tip
/// is within the introducer. Fed on, it appears there in its unloaded shape; so one instrument is exchanged for
/// another.
#include <cstdint>

#include "core/model/inputs.h"
#include "core/model/rod.h"
#include "core/model/state.h"

namespace ostium::core {

/// With less than this inserted, that of the three distal elements, a rod is not in the body.
double least_inserted_m(const Rod& rod);

/// Whether a rod takes part.
bool in_body(const Rod& rod, const RodState& state);

/// The first element inside when `inserted_m` of a rod is, if it has not been fed yet; N: not in the body.
int first_element_for(const Rod& rod, double inserted_m);

/// Before a step that feeds: elements enter or leave, while positions and length belong to one moment. Writes
/// state.first and slack_m, and the fields of these elements; done twice, it changes nothing more.
void renew_elements(const Rod& rod, const RodInputs& inputs, double step_s, RodState& state);

/// Feeds for one step: writes state.inserted_m, and the fields of a rod that appears. At both ends of the instrument it
/// stops, and says so in `trouble`.
void feed(const Rod& rod, const RodInputs& inputs, double step_s, RodState& state, std::uint32_t& trouble);

/// Makes `inside` the part of `rod` that `state` has inside the introducer.
void cut_at_introducer(const Rod& rod, const RodState& state, Rod& inside);

/// Director d3 of an end's frame: the direction of advance.
Eigen::Vector3d axis(const EndState& end);

}  // namespace ostium::core
