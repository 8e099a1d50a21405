#pragma once
/// The one owner of the beat: phase, ejection, pressures. Wall, flow, ECG and every pressure trace follow its phase.
///
/// The left ventricle ejects its stroke while the valve is open, into a three-element windkessel (Westerhof 1969):
///   C dP/dt = Q - P / R,   p_aorta = P + Z Q
/// so that pressure answers to rate, extrasystoles and vasodilators. R, C and Z give 120/80 mmHg, mean 93, at 70 beats
/// a minute and 5 L/min. Its ventricle's pressure is the aorta's during ejection, and that of filling in diastole.
#include <cstdint>

#include "core/base/fields.h"

namespace ostium::vascular {

struct HeartModel {
  double stroke_m3 = 71e-6;            ///< of a beat after a whole filling at 70 beats a minute
  double resistance_Pa_s_m3 = 1.53e8;  ///< R: 93 mmHg at 5 L/min
  double compliance_m3_Pa = 1.27e-8;   ///< C: 1.7 mL/mmHg
  double impedance_Pa_s_m3 = 5.3e6;    ///< Z: 0.04 mmHg s/mL
  /// Extrasystoles per second of late diastole while something presses the ventricle's wall: then every second beat or
  /// so is one [estimate].
  double ectopic_per_s = 5;
  std::uint64_t seed = 1;  ///< when they come
};

struct HeartInputs {
  double rate_1_min = 70;  ///< of the sinus node; limited as in heart_cycle.h
  double irritation = 0;   ///< [0, 1]: how much a wire or catheter touches the ventricle's wall
  double dilation = 0;     ///< [0, 1]: of the body's arterioles, by drugs: takes so much off the resistance
};

struct HeartState {
  double phase = 0;              ///< [0, 1), 0 is the R wave
  double windkessel_Pa = 11300;  ///< P
  double ejection_m3_s = 0;      ///< Q; below zero as the valve closes
  double stroke_m3 = 71e-6;      ///< of the running beat
  double filled_s = 0.55;        ///< diastole so far
  bool ectopic = false;          ///< the running beat is one
  bool next_ectopic = false;     ///< the next one is, it comes early
  std::uint64_t draws = 0;       ///< random numbers drawn
  double time_s = 0;             ///< since the start
  double since_R_s = 0;
  double cycle_s = 60.0 / 70;  ///< length of the last whole beat
  int beats = 0;               ///< R waves so far
};
constexpr auto fields(const HeartState*) {
  using S = HeartState;
  return std::tuple{core::field("phase", &S::phase),
                    core::field("windkessel_Pa", &S::windkessel_Pa),
                    core::field("ejection_m3_s", &S::ejection_m3_s),
                    core::field("stroke_m3", &S::stroke_m3),
                    core::field("filled_s", &S::filled_s),
                    core::field("ectopic", &S::ectopic),
                    core::field("next_ectopic", &S::next_ectopic),
                    core::field("draws", &S::draws),
                    core::field("time_s", &S::time_s),
                    core::field("since_R_s", &S::since_R_s),
                    core::field("cycle_s", &S::cycle_s),
                    core::field("beats", &S::beats)};
}

/// What the heart gives at a moment.
struct Pressures {
  double aorta_Pa = 0, ventricle_Pa = 0;
};

/// Advances by `dt_s` (up to 10 ms). Never jumps in phase: an extrasystole runs through the rest of diastole faster,
/// and the beat after its own systole is longer.
void step(const HeartModel& model, const HeartInputs& inputs, double dt_s, HeartState& state);

Pressures pressures(const HeartModel& model, const HeartState& state);

/// Stroke volume that leaves per unit of phase, of 1: integrates to 1, with a short return flow as the valve closes.
double ejection_shape(double phase);
/// Share of the ventricle's pressure that is the contracting wall's: 0 in diastole, 1 during ejection.
double ventricle_activity(double phase);
/// In diastole, with the atrial kick before the R wave.
double filling_pressure_Pa(double phase);

}  // namespace ostium::vascular
