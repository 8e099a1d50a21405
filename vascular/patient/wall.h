#pragma once
/// The patient's lumen as the wall that contact knows: 24 frames of one beat.
#include "core/wall/surface.h"
#include "vascular/patient/patient.h"

namespace ostium::vascular {

/// Lesions opened by so much (0: as they are, 1: healthy). Stiffness and friction are left to the caller. Its frame is
/// beat_frames times the phase, its sway the depth of breath.
core::SurfaceDescription wall_of(const MovingLumen& lumen, double opened = 0);

/// The frame that belongs to a phase of the heart, for SurfaceMotion.
double frame_at(double phase);

}  // namespace ostium::vascular
