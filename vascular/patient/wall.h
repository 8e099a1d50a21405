#pragma once
/// The patient's lumen as a contact wall: 24 frames of one cardiac cycle.
#include "core/wall/surface.h"
#include "vascular/patient/patient.h"

namespace ostium::vascular {

/// `opened`: 0 with lesions as they are, 1 healthy. The caller sets stiffness and friction. Its frame is beat_frames
/// times the phase, its sway the depth of breath.
core::SurfaceDescription wall_of(const MovingLumen& lumen, double opened = 0);

/// The frame for a cardiac phase, for SurfaceMotion.
double frame_at(double phase);

}  // namespace ostium::vascular
