#pragma once
/// What contrast does to the heart while it is in the muscle: the rate falls, the ventricles press less, and so does
/// the pressure, for some seconds after each injection.
///
///   iodine in a side's muscle   m' = (what its arteries bring) - m / 8 s     sides: left, right coronary
///   effect                      e = 1 - exp(-m / reference)
///   rate                        -5.5 % e(left), -10 % e(right): in dogs nonionic contrast took 135 to 130 and 134 to
///                               125 beats a minute (J Lab Clin Med 1990;115:122), which is e = 0.7 here
///   contraction                 -22 % e(left), -12 % e(right): a systolic pressure that falls by 5 to 10 mmHg
///                               [estimate; published is that it falls, and is back within 30 s]
/// The references are what a full injection by hand leaves in the muscle [estimate].
#include <array>

#include "core/base/fields.h"
#include "vascular/heart/circulation.h"

namespace ostium::vascular {

struct ContrastReactionModel {
  double washes_out_s = 8;
  std::array<double, 2> reference_kg{1.0e-3, 0.5e-3};
  std::array<double, 2> rate{-0.055, -0.1}, contraction{-0.22, -0.12};
};

struct ContrastReactionState {
  std::array<double, 2> in_muscle_kg{};  ///< left, right
};
constexpr auto fields(const ContrastReactionState*) {
  return std::tuple{core::field("in_muscle_kg", &ContrastReactionState::in_muscle_kg)};
}

/// `came_kg`: iodine that has come into the muscle in this step, by side.
void step(const ContrastReactionModel& model, const std::array<double, 2>& came_kg, double dt_s,
          ContrastReactionState& state);
void react(const ContrastReactionModel& model, const ContrastReactionState& state, CirculationInputs& body);

}  // namespace ostium::vascular
