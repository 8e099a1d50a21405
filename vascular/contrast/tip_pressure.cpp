#include "vascular/contrast/tip_pressure.h"

#include <algorithm>
#include <cmath>

namespace ostium::vascular {

namespace {

/// In the place of a beat's lowest reading: the line was blocked. Readings in a ventricle may be below 0.
constexpr double was_blocked_Pa = -1e6;
constexpr double narrow_pulse = 0.6, deep_diastole = 0.65;  // of the aorta's pulse and pressure

Trace judged(const TipPressureState& s, const TipPressureInputs& in) {
  // A line that fills again after an injection rises from 0, which is no diastole.
  if (in.blocked || s.low_Pa == was_blocked_Pa) return Trace::absent;
  const double pulse = s.high_Pa - s.low_Pa, aorta_pulse = s.aorta_high_Pa - s.aorta_low_Pa;
  if (s.low_Pa < 0.25 * s.aorta_low_Pa && s.high_Pa > 0.92 * s.aorta_high_Pa) return Trace::ventricle;
  if (s.low_Pa < deep_diastole * s.aorta_low_Pa && pulse > aorta_pulse) return Trace::ventricularised;
  return pulse < narrow_pulse * aorta_pulse ? Trace::damped : Trace::normal;
}

}  // namespace

void step(const TipPressureModel& model, const TipPressureInputs& in, double dt_s, TipPressureState& s) {
  double there = in.pressures.aorta_Pa;
  if (in.in_ventricle) there = in.pressures.ventricle_Pa;
  if (in.tip.where == TipPlace::coronary) there = in.coronary_Pa;
  const double covered = std::clamp(in.covered, 0.0, 0.999);
  there *= 1 - model.lost * covered;
  if (in.blocked) there = 0;
  // The line fills through the open part of the hole: fourth power of its radius.
  const double open = (1 - covered) * (1 - covered);
  s.reading_Pa += -std::expm1(-dt_s * open / model.line_s) * (there - s.reading_Pa);
  s.low_Pa = in.blocked ? was_blocked_Pa : std::min(s.low_Pa, s.reading_Pa),
  s.high_Pa = std::max(s.high_Pa, s.reading_Pa);
  s.sum_Pa += s.reading_Pa, s.count += 1;
  s.aorta_low_Pa = std::min(s.aorta_low_Pa, in.pressures.aorta_Pa);
  s.aorta_high_Pa = std::max(s.aorta_high_Pa, in.pressures.aorta_Pa);
  if (!in.beat_begins) return;
  s.trace = judged(s, in);
  if (s.trace != Trace::absent) s.mean_Pa = s.sum_Pa / s.count, s.pulse_Pa = s.high_Pa - s.low_Pa;
  // The line may still fill again as the next beat begins.
  const bool fills = in.blocked || (s.low_Pa == was_blocked_Pa && there - s.reading_Pa > 0.05 * in.pressures.aorta_Pa);
  s.low_Pa = fills ? was_blocked_Pa : 1e6, s.aorta_low_Pa = 1e6, s.high_Pa = s.aorta_high_Pa = 0, s.sum_Pa = 0,
  s.count = 0;
}

const char* trace_name(Trace trace) {
  constexpr const char* names[] = {"normal", "damped", "ventricularised", "ventricle", "absent"};
  return names[static_cast<int>(trace)];
}

}  // namespace ostium::vascular
