#include "vascular/physiology/contrast_reaction.h"

#include <cmath>

namespace ostium::vascular {

void step(const ContrastReactionModel& m, const std::array<double, 2>& came_kg, double dt, ContrastReactionState& s) {
  constexpr double traces_kg = 1e-9;
  for (std::size_t side = 0; side < 2; ++side) {
    double& in = s.in_muscle_kg[side];
    in = in * std::exp(-dt / m.washes_out_s) + came_kg[side];
    if (in < traces_kg) in = 0;
  }
}

void react(const ContrastReactionModel& m, const ContrastReactionState& s, CirculationInputs& body) {
  double contraction = 1;
  for (std::size_t side = 0; side < 2; ++side) {
    const double effect = -std::expm1(-s.in_muscle_kg[side] / m.reference_kg[side]);
    body.rate_effect += m.rate[side] * effect;
    contraction += m.contraction[side] * effect;
  }
  body.contraction *= contraction;
}

}  // namespace ostium::vascular
