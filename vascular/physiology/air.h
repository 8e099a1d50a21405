#pragma once
/// Air: a bubble in the line from the syringe, and what of it has come into the arterioles of the muscle.
///
/// A bubble moves with what is pushed through the line or drawn back. Out of the tip it goes where the blood goes. In
/// the muscle it closes arterioles, and pressure drives it through them, in a time constant of `leaves_s` at 93 mmHg:
///
///   conductance x exp(-V / (closes_s Q)),   Q: that muscle's flow at rest;   dV/dt = -V p / (93 mmHg leaves_s)
///
/// Both numbers are fitted to what operators see, of 0.15 mL hardly anything, of 0.3 to 0.5 mL a minute or two of slow
/// flow and ST, as pigs show (2 uL/kg: 60 to 120 s at a high pressure, more than ten minutes at a low one). A large
/// one makes the ventricles fibrillate: of dogs with 0.02 mL/kg in the LAD 28 % died (Stegmann 1980).
#include <cstdint>
#include <vector>

#include "vascular/contrast/contrast.h"

namespace ostium::vascular {

struct AirModel {
  double closes_s = 0.067;  ///< 0.1 mL in an LAD of 1.5 mL/s
  double leaves_s = 100;
  double fatal_m3 = 1.5e-6;   ///< 0.02 mL/kg of 75 kg
  double fatal_share = 0.28;  ///< of people, at that volume; goes as its square
};

struct AirState {
  double line_m3 = 0, line_at = 0;  ///< the bubble in the line, and where: 0 at the syringe, 1 at the tip
  std::vector<double> muscle_m3;    ///< (#branches) in the arterioles
  double elsewhere_m3 = 0;          ///< drawn out, gone down the aorta, or through the muscle
};
constexpr auto fields(const AirState*) {
  using S = AirState;
  return std::tuple{core::field("line_m3", &S::line_m3), core::field("line_at", &S::line_at),
                    core::field("muscle_m3", &S::muscle_m3), core::field("elsewhere_m3", &S::elsewhere_m3)};
}

/// Adds a bubble at the syringe's end of the line. One that is there already is taken along.
void add_to_line(double volume_m3, AirState& state);

/// What moves in the line in a step: positive towards the tip.
struct AirInputs {
  double pushed_m3 = 0, dead_m3 = 1;
  TipPlace tip;
  double aorta_Pa = 0;
};

/// Returns what came into the coronary arteries in this step, m3.
double step(const AirModel& model, const ContrastModel& roots, const FlowModel& flow, const FlowState& blood,
            const AirInputs& inputs, double dt_s, AirState& state);

/// Share of each branch's arterioles that is open; `open` is resized.
void open_share(const AirModel& model, const FlowModel& flow, const AirState& state, std::vector<double>& open);

double in_muscle_m3(const AirState& state);

/// Whether a heart of this seed fibrillates with that much air in its arteries.
bool is_fatal(const AirModel& model, std::uint64_t seed, double volume_m3);

}  // namespace ostium::vascular
