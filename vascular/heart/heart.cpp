#include "vascular/heart/heart.h"

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "vascular/motion/heart_cycle.h"

namespace ostium::vascular {

namespace {

using units::mmHg;

constexpr double earliest_ectopic = 0.52, latest_ectopic = 0.72, hurry = 4, pause_slowing = 0.6;
constexpr double ectopic_strength = 0.7;  // an early beat has had little time to recover [estimate]

/// Of the ventricles without a pacemaker.
double own_rate_1_min(const HeartModel& model, const HeartState& s) {
  return s.rhythm == Rhythm::block ? model.escape_1_min : s.circulation.rate_1_min;
}

/// Beats with no pulse add up; after too many the heart stops. One that has come back under compressions is found when
/// they cease.
void end_beat(const HeartModel& model, HeartState& s) {
  s.beat = {s.high_Pa, s.low_Pa, s.sum_Pa_s / std::max(s.cycle_s, 1e-3), s.ejected_m3};
  s.high_Pa = 0, s.low_Pa = 1e6, s.sum_Pa_s = 0, s.ejected_m3 = 0;
  const bool pulse = beats(s) && s.beat.systolic_Pa >= model.pulse_Pa;
  if (!pulse)
    s.pulseless_s += (s.compressed ? model.circulation.compressions.fails : 1) * s.cycle_s;
  else if (!s.compressed)
    s.pulseless_s = 0;
  s.compressed = false;
  if (!pulse && s.pulseless_s > model.dies_s) s.rhythm = Rhythm::asystole;
}

/// Arterioles without oxygen give way, against what the reflex asks of them, so that little pressure is left of a small
/// flow [estimate; how much is set with the compressions' pressure].
void dilate(double dt_s, CirculationInputs& body, HeartState& s) {
  constexpr double most = 0.75, time_s = 20;
  s.anoxia += -std::expm1(-dt_s / time_s) * ((s.pulseless_s > 0 ? 1 : 0) - s.anoxia);
  body.dilation = std::max(body.dilation, most * s.anoxia);
}

void compress(const CompressionModel& model, double rate_1_min, double dt_s, CirculationInputs& body, HeartState& s) {
  if (rate_1_min <= 0) {
    s.compression = 0;
    return;
  }
  s.compressed = true;
  s.compression = std::fmod(s.compression + rate_1_min / 60 * dt_s, 1.0);
  body.pressed_Pa = pressed_Pa(model, s.compression);
}

}  // namespace

double rate_1_min(const HeartModel& model, const HeartState& s) {
  return std::max(own_rate_1_min(model, s), s.paced_1_min);
}

HeartModel heart_of(std::uint64_t seed, HeartModel mean) {
  mean.seed = seed;
  if (seed > 0) mean.paces_from_mA = 0.3 + 0.4 * core::uniform(seed, 24, 0);
  return mean;
}

void step(const HeartModel& model, const HeartInputs& inputs, double dt_s, HeartState& s) {
  if (inputs.irritation > 0 && beats(s) && !s.next_ectopic && s.phase > earliest_ectopic && s.phase < latest_ectopic) {
    const double p = 1 - std::exp(-model.ectopic_per_s * std::min(inputs.irritation, 1.0) * dt_s);
    if (core::uniform(model.seed, 11, s.draws) < p) s.next_ectopic = true;
    s.draws += 1;
  }
  if (!inputs.body.reflexes || s.time_s == 0) s.circulation.rate_1_min = inputs.rate_1_min;
  s.paced_1_min = beats(s) && inputs.pacing_mA >= model.paces_from_mA ? inputs.pacing_1_min : 0;
  double speed = phase_speed(s.phase, rate_1_min(model, s));
  if (s.next_ectopic)
    speed *= hurry;
  else if (s.ectopic && s.phase > 0.42)
    speed *= pause_slowing;
  s.phase += speed * dt_s;
  s.time_s += dt_s;
  s.since_R_s += dt_s;
  const bool next = s.phase >= 1;
  if (next) s.phase -= 1;
  CirculationInputs body = inputs.body;
  body.phase = s.phase, body.resting_rate_1_min = inputs.rate_1_min;
  if (!beats(s)) body.contraction = 0;
  dilate(dt_s, body, s);
  compress(model.circulation.compressions, inputs.compressions_1_min, dt_s, body, s);
  if (next ? s.next_ectopic : s.ectopic) body.contraction *= ectopic_strength;
  step(model.circulation, body, dt_s, s.circulation);
  const double aorta = pressures(model, s).aorta_Pa;
  s.high_Pa = std::max(s.high_Pa, aorta), s.low_Pa = std::min(s.low_Pa, aorta);
  s.sum_Pa_s += aorta * dt_s, s.ejected_m3 += s.circulation.aortic_m3_s * dt_s;
  if (!next) return;
  s.beats += 1;
  s.cycle_s = s.since_R_s;
  s.since_R_s = s.phase / speed;
  s.ectopic = s.next_ectopic, s.next_ectopic = false;
  s.paced = s.paced_1_min > own_rate_1_min(model, s);
  end_beat(model, s);
}

Pressures pressures(const HeartModel& model, const HeartState& s) {
  const CirculationModel& body = model.circulation;
  // Wave reflected from the legs: a low hump after the notch, as high as the stroke that sent it.
  const double hump = std::exp(-std::pow((s.phase - 0.45) / 0.04, 2)) * std::min(1.0, s.beat.stroke_m3 / 70e-6);
  const double aorta = s.circulation.arteries_m3 / body.arteries_m3_Pa +
                       body.impedance_Pa_s_m3 * s.circulation.aortic_m3_s + 2.5 * mmHg * hump;
  return {aorta, s.circulation.left_Pa};
}

}  // namespace ostium::vascular
