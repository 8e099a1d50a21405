#pragma once
/// Force feedback: the force each clamp must hold, from the simulated instrument's resistance to moving its base.
///
/// A clamp is a brake: it resists pushing and turning alike, and cannot push back. So it closes only against the hand's
/// last direction, and only as far as the instrument resists that direction:
///   level_N = |(max(0, s push), max(0, c torque / r))|,  s, c: signs of the last push and turn, r: the tool's radius.
/// A box with a brake for pushing and one for turning gets the two parts apart: a guide whose turning is resisted then
/// slides as freely as before (with one clamp for both it does not, which the thesis found: Korzeniowski 2015).
/// A brake only dissipates energy, so nothing can build up. The possible fault is a clamp that opens and closes in turn
/// (a buzz), because releasing it lets the hand spring, or because it follows sensor noise: with a stiff instrument,
/// 0.02 mm of sensor noise makes a load noise that drowns small loads. Therefore a direction counts as reversed only
/// after more movement than sensor noise and delay can cause; loads are low-pass filtered; each load is held while it
/// changes by less than a hand can feel, both relatively (Weber's law) and absolutely (threshold); and the level's slew
/// rate is limited.
#include <array>
#include <cstdint>

#include "device/host/strokes.h"
#include "device/protocol/calibration.h"
#include "device/protocol/report.h"

namespace ostium::device {

struct ClampSettings {
  std::array<double, tools> radius_m{1.0e-3, 0.18e-3, 0.5e-3, 0.18e-3};  ///< of each tool at its clamp
  double most_N = 8;                                                     ///< limit, whatever the simulation gives
  double rise_N_s = 100, fall_N_s = 400;
  double reversal_mm = 0.3, reversal_deg = 6;  ///< movement in the other direction that counts as a reversal
  double smooth_s = 0.016;                     ///< time constant of the low pass of loads, 10 Hz
  double least_felt = 0.1;                     ///< relative change of load that a hand does not feel: the level is held
  double least_push_N = 0.03, least_torque_Nm = 6e-5;  ///< the same, absolute; torque on a torque device of 2 mm
  double settle_s = 0.2;                               ///< a changed load is followed for this long, then held again
  double stale_s = 0.03;                               ///< loads older than this open the clamps
};

/// Push and torque on one instrument's base, from the step's RodReport.
struct ClampLoad {
  double push_N = 0, torque_Nm = 0;
};

/// Direction of a movement, with hysteresis.
struct Direction {
  int sign = 0;  ///< 0: has not moved yet
  double turned_at = 0, position = 0;
};

/// A load as used for the clamp level.
struct HeldLoad {
  double smooth = 0, held = 0;  ///< after the low pass; the same with dead band
  double followed_at = 0, follow_for_s = 0;
};

struct ClampState {
  std::array<Direction, tools> along{}, around{};
  std::array<HeldLoad, tools> push_N{}, torque_Nm{};
  std::array<double, tools> level_N{};   ///< of the one clamp, or of the brake for pushing
  std::array<double, tools> rotary_N{};  ///< of the brake for turning, at the tool's surface; 0 where there is none
  std::uint16_t sequence = 0;            ///< of the last OUT report
  std::uint16_t arm_sequence = 0;        ///< sequence of the report that raised ARM
  bool arm = false;                      ///< as last sent
  bool stopped = false;                  ///< the box was stopped: it is armed again only after `arm` was withdrawn
};

/// What the clamps are to do now.
struct ClampRequest {
  bool arm = false;  ///< the operator wants force feedback
  std::array<ClampLoad, tools> load{};
  double load_age_s = 0;         ///< time since the step that gave the loads
  bool paused = false;           ///< the simulation stands still: clamps open, so that the operator can draw back
  bool separate_brakes = false;  ///< the box has them
};

/// Updates each tool's level over the box time between two reports. NaN loads count as zero. The clamp of a tool that
/// is not seen opens at once.
void advance_clamps(const ClampSettings& settings, const ClampRequest& request, const Movements& movements,
                    ClampState& state);

/// The next OUT report: levels relative to each track's full scale, and ARM, which is lowered and raised again if the
/// watchdog has opened the clamps.
OutReport clamp_report(const ClampRequest& request, const Calibration& calibration, const InReport& report,
                       ClampState& state);

}  // namespace ostium::device
