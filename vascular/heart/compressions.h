#pragma once
/// Chest compressions: a hand presses the heart, and less so the vessels of the lungs, from outside.
///
///   P(x) = P_most sin(pi x / d) for x < d, else 0;   x in [0, 1): share of a compression's period, d: of it pressed
///
/// The valves turn that into flow: between the sternum and the spine ("cardiac pump") by the part that only the heart
/// feels, the rest drives blood out of the whole chest ("thoracic pump"). P_most is set so that output and pressures
/// are those measured in people (tests/vascular/flow/rescue_test.cpp); how it is shared is an estimate.
#include "core/base/units.h"

namespace ostium::vascular {

struct CompressionModel {
  double most_Pa = 29 * units::mmHg;  ///< P_most
  double pressed = 0.5;               ///< d: as long down as up (guidelines)
  double of_vessels = 0.5;            ///< share of it that the lungs' vessels feel [estimate]
  /// How fast a heart without a pulse fails meanwhile: survival falls by 3 to 4 % a minute instead of 7 to 10 (American
  /// Heart Association).
  double fails = 0.4;
};

/// Pressure on the heart.
double pressed_Pa(const CompressionModel& model, double share_of_period);

}  // namespace ostium::vascular
