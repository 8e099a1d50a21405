#pragma once
/// The heart: rhythm, phase, and the circulation that it drives. Wall, flow, ECG and every pressure trace follow its
/// phase; pressures and volumes are those of the closed circulation (circulation.h).
#include <cstdint>

#include "core/base/fields.h"
#include "vascular/heart/circulation.h"

namespace ostium::vascular {

enum class Rhythm {
  sinus,
  block,         ///< third-degree: the ventricles beat by themselves, slowly
  fibrillation,  ///< of the ventricles, which eject nothing
  asystole
};
inline constexpr const char* rhythm_names[] = {"sinus", "AV block", "VF", "asystole"};

struct HeartModel {
  CirculationModel circulation;
  /// Extrasystoles per second of late diastole while something touches the ventricle's wall: about every second beat
  /// then is one [estimate].
  double ectopic_per_s = 5;
  double escape_1_min = 40;  ///< rate of the ventricles in a block [textbook: 20 to 40, 40 to 60 from the junction]
  /// A beat below this makes no pulse [estimate: a carotid pulse is felt down to about 60 mmHg, or less].
  double pulse_Pa = 50 * units::mmHg;
  double paces_from_mA = 0.5;  ///< a wire's current that the right ventricle follows (0.3 to 0.7: usually below 1)
  double dies_s = 180;         ///< without a pulse, until the heart stops [estimate: 3 to 5 minutes]
  std::uint64_t seed = 1;      ///< determines when extrasystoles occur
};

/// A person's: what the heart of a seed differs in. Seed 0 is the mean.
HeartModel heart_of(std::uint64_t seed, HeartModel mean = {});

struct HeartInputs {
  double rate_1_min = 70;                  ///< of the sinus node at rest; clamped as in heart_cycle.h
  double compressions_1_min = 0;           ///< of the chest; 0: none
  double pacing_1_min = 0, pacing_mA = 0;  ///< of a temporary pacemaker's wire in the right ventricle
  double irritation = 0;                   ///< [0, 1]: contact of a wire or catheter with the ventricle's wall
  CirculationInputs body = {};             ///< its phase, resting rate and stopped contraction are set by the step
};

/// Of the last complete beat.
struct BeatSummary {
  double systolic_Pa = 15600, diastolic_Pa = 10100, mean_Pa = 12500;  ///< in the aorta
  double stroke_m3 = 73e-6;                                           ///< net
};
constexpr auto fields(const BeatSummary*) {
  using S = BeatSummary;
  return std::tuple{core::field("systolic_Pa", &S::systolic_Pa), core::field("diastolic_Pa", &S::diastolic_Pa),
                    core::field("mean_Pa", &S::mean_Pa), core::field("stroke_m3", &S::stroke_m3)};
}

struct HeartState {
  double phase = 0;  ///< [0, 1), 0 is the R wave
  Rhythm rhythm = Rhythm::sinus;
  CirculationState circulation;
  BeatSummary beat;
  double high_Pa = 0, low_Pa = 1e6, sum_Pa_s = 0, ejected_m3 = 0;  ///< of the current beat
  double pulseless_s = 0;     ///< since the last beat with a pulse; under compressions it runs slower
  double anoxia = 0;          ///< [0, 1): of the arterioles
  double compression = 0;     ///< [0, 1): of the period of a compression
  bool compressed = false;    ///< the chest was, in the current beat
  double paced_1_min = 0;     ///< rate at which a pacemaker is followed; 0: it is not
  bool paced = false;         ///< the current beat is its
  bool ectopic = false;       ///< the current beat is an extrasystole
  bool next_ectopic = false;  ///< the next beat is an extrasystole, which comes early
  std::uint64_t draws = 0;    ///< random numbers drawn
  double time_s = 0;          ///< since the start
  double since_R_s = 0;
  double cycle_s = 60.0 / 70;  ///< length of the last complete beat
  int beats = 0;               ///< R waves so far
};
constexpr auto fields(const HeartState*) {
  using S = HeartState;
  return std::tuple{core::field("phase", &S::phase),
                    core::field("rhythm", &S::rhythm),
                    core::field("circulation", &S::circulation),
                    core::field("beat", &S::beat),
                    core::field("high_Pa", &S::high_Pa),
                    core::field("low_Pa", &S::low_Pa),
                    core::field("sum_Pa_s", &S::sum_Pa_s),
                    core::field("ejected_m3", &S::ejected_m3),
                    core::field("pulseless_s", &S::pulseless_s),
                    core::field("anoxia", &S::anoxia),
                    core::field("compression", &S::compression),
                    core::field("compressed", &S::compressed),
                    core::field("paced_1_min", &S::paced_1_min),
                    core::field("paced", &S::paced),
                    core::field("ectopic", &S::ectopic),
                    core::field("next_ectopic", &S::next_ectopic),
                    core::field("draws", &S::draws),
                    core::field("time_s", &S::time_s),
                    core::field("since_R_s", &S::since_R_s),
                    core::field("cycle_s", &S::cycle_s),
                    core::field("beats", &S::beats)};
}

/// Pressures of the heart at a moment.
struct Pressures {
  double aorta_Pa = 0, ventricle_Pa = 0;
};

/// Advances by `dt_s` (up to 10 ms). The phase never jumps: an extrasystole runs through the rest of diastole faster,
/// and a longer pause follows it.
void step(const HeartModel& model, const HeartInputs& inputs, double dt_s, HeartState& state);

Pressures pressures(const HeartModel& model, const HeartState& state);

/// Whether the ventricles beat, as they do not in fibrillation and asystole.
inline bool beats(const HeartState& s) { return s.rhythm == Rhythm::sinus || s.rhythm == Rhythm::block; }

/// Rate of the ventricles, per minute.
double rate_1_min(const HeartModel& model, const HeartState& state);

/// Phases between which the aortic valve's leaflets stand open for a wire.
inline constexpr double valve_opens = 0.07, valve_closes = 0.35;

}  // namespace ostium::vascular
