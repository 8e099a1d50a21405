#include "vascular/heart/heart.h"

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "core/base/units.h"
#include "vascular/motion/heart_cycle.h"
#include "vascular/motion/heart_motion.h"

namespace ostium::vascular {

namespace {

using units::mmHg;

using units::pi;
constexpr double opens = 0.07, closes = 0.35;      // phases of the aortic valve
constexpr double closure = 0.02, returned = 0.03;  // return flow at valve closure: duration in phase, share of stroke
constexpr double filling_needed_s = 0.55;          // length of diastole for a full stroke
constexpr double earliest_ectopic = 0.52, latest_ectopic = 0.72, hurry = 4, pause_slowing = 0.6;

double stroke_after(const HeartModel& model, double filled_s) {
  // Filling is fast at first; an early beat ejects little, one after a pause slightly more.
  const double share = 1.18 * (1 - std::exp(-filled_s / (filling_needed_s / 1.877)));
  return model.stroke_m3 * std::max(0.1, share);
}

}  // namespace

double ejection_shape(double phase) {
  if (phase > opens && phase < closes) {
    const double x = (phase - opens) / (closes - opens), y = std::pow(x, 0.7);
    // Half a sine of x^0.7, since ejection peaks early; its integral over x is 0.65657.
    return (1 + returned) * std::sin(pi * y) / 0.65657 / (closes - opens);
  }
  if (phase >= closes && phase < closes + closure)
    return -returned * pi / 2 * std::sin(pi * (phase - closes) / closure) / closure;
  return 0;
}

double ventricle_activity(double phase) {
  const double rises = smooth_step(-0.01, opens, phase < 0.5 ? phase : phase - 1);
  const double falls = 1 - smooth_step(closes - 0.01, 0.45, phase);
  return phase < 0.5 ? std::min(rises, falls) : rises;
}

double filling_pressure_Pa(double phase) {
  const double kick = phase > 0.88 ? std::pow(std::sin(pi * (phase - 0.88) / 0.12), 2) : 0;
  const double early = phase > 0.4 ? smooth_step(0.45, 0.85, phase) : 1;
  return mmHg * (4 + 5 * early + 7 * kick);
}

void step(const HeartModel& model, const HeartInputs& inputs, double dt_s, HeartState& s) {
  if (inputs.irritation > 0 && !s.next_ectopic && s.phase > earliest_ectopic && s.phase < latest_ectopic) {
    const double p = 1 - std::exp(-model.ectopic_per_s * std::min(inputs.irritation, 1.0) * dt_s);
    if (core::uniform(model.seed, 11, s.draws) < p) s.next_ectopic = true;
    s.draws += 1;
  }
  double speed = phase_speed(s.phase, inputs.rate_1_min);
  if (s.next_ectopic)
    speed *= hurry;
  else if (s.ectopic && s.phase > 0.42)
    speed *= pause_slowing;
  const double R = model.resistance_Pa_s_m3 * (1 - 0.5 * std::clamp(inputs.dilation, 0.0, 1.0));
  s.ejection_m3_s = s.stroke_m3 * ejection_shape(s.phase) * speed;
  // Implicit in P.
  s.windkessel_Pa =
      (s.windkessel_Pa + dt_s / model.compliance_m3_Pa * s.ejection_m3_s) / (1 + dt_s / (R * model.compliance_m3_Pa));
  if (s.phase > 0.45) s.filled_s += dt_s;
  s.phase += speed * dt_s;
  s.time_s += dt_s;
  s.since_R_s += dt_s;
  if (s.phase < 1) return;
  s.phase -= 1;
  s.beats += 1;
  s.cycle_s = s.since_R_s;
  s.since_R_s = s.phase / speed;
  s.ectopic = s.next_ectopic, s.next_ectopic = false;
  s.stroke_m3 = stroke_after(model, s.filled_s) * (s.ectopic ? 0.7 : 1);
  s.filled_s = 0;
}

Pressures pressures(const HeartModel& model, const HeartState& s) {
  // Wave reflected from the legs: a low hump after the notch.
  const double hump = std::exp(-std::pow((s.phase - 0.43) / 0.04, 2));
  const double aorta = s.windkessel_Pa + model.impedance_Pa_s_m3 * s.ejection_m3_s + 2.5 * mmHg * hump;
  const double active = ventricle_activity(s.phase);
  const double weak = std::min(1.0, s.stroke_m3 / (0.45 * model.stroke_m3));  // a beat that does not open the valve
  const double top = weak * (aorta + (s.ejection_m3_s > 0 ? 2 * mmHg : 0));
  return {aorta, active * top + (1 - active) * filling_pressure_Pa(s.phase)};
}

}  // namespace ostium::vascular
