#pragma once
/// Pressure reading of a catheter, depending on where its end hole is.
///
/// Three causes, three traces: an end hole against a wall gives a damped trace (lower mean, narrow pulse); a catheter
/// that fills an ostium reads the pressure behind it, which the myocardium determines (ventricularised: steep diastolic
/// fall, wide pulse, no notch); contrast or a thick wire in the lumen gives no reading.
#include "vascular/contrast/contrast.h"

namespace ostium::vascular {

enum class Trace { normal, damped, ventricularised, ventricle, absent };

struct TipPressureModel {
  double line_s = 0.010;  ///< time constant of an open line [usual resonance 15 to 25 Hz, from memory]
  double lost = 0.45;     ///< share of the pressure lost when the hole is almost closed
};

struct TipPressureInputs {
  Pressures pressures;
  double coronary_Pa = 0;  ///< in the tip's cell (FlowState::pressure_Pa), if the tip is in a coronary
  TipPlace tip;
  bool in_ventricle = false;
  double covered = 0;        ///< [0, 1): share of the end hole against a wall
  bool blocked = false;      ///< during injection, or with a 0.035 in wire inside
  bool beat_begins = false;  ///< R wave in this step
};

struct TipPressureState {
  double reading_Pa = 0;
  double low_Pa = 1e6, high_Pa = 0, sum_Pa = 0;  ///< of the current beat; low_Pa -1e6: it has been blocked
  int count = 0;                                 ///< number of readings in it
  double aorta_low_Pa = 1e6, aorta_high_Pa = 0;
  Trace trace = Trace::normal;       ///< of the last complete beat
  double mean_Pa = 0, pulse_Pa = 0;  ///< of the last complete beat with a trace
};
constexpr auto fields(const TipPressureState*) {
  using S = TipPressureState;
  return std::tuple{core::field("reading_Pa", &S::reading_Pa),
                    core::field("low_Pa", &S::low_Pa),
                    core::field("high_Pa", &S::high_Pa),
                    core::field("sum_Pa", &S::sum_Pa),
                    core::field("count", &S::count),
                    core::field("aorta_low_Pa", &S::aorta_low_Pa),
                    core::field("aorta_high_Pa", &S::aorta_high_Pa),
                    core::field("trace", &S::trace),
                    core::field("mean_Pa", &S::mean_Pa),
                    core::field("pulse_Pa", &S::pulse_Pa)};
}

void step(const TipPressureModel& model, const TipPressureInputs& inputs, double dt_s, TipPressureState& state);
const char* trace_name(Trace trace);

}  // namespace ostium::vascular
