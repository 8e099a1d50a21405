#pragma once
/// Force feedback: what each clamp has to hold, from what the simulated instrument resists its base's movement with.
///
/// A clamp is a brake: it resists pushing and turning alike, it cannot push back. So it closes only against the
/// direction in which the hand last went, and only as far as the instrument resists that direction:
///   level_N = |(max(0, s push), max(0, c torque / r))|,  s, c: signs of the last push and turn, r: the tool's radius.
/// A brake takes energy and never gives any, so nothing can build up; what could go wrong is a clamp that opens and
/// closes by turns (a buzz), because its release lets the hand spring, or because it follows a sensor that trembles: a
/// trembling of 0.02 mm makes of a stiff instrument's load a noise that a small load drowns in. So a direction counts
/// as changed only after some movement the other way, more than sensor noise and delay can make; loads go through a low
/// pass; each rests while it changes by less than a hand feels, in parts of itself (Weber's law) and at the least
/// (absolute threshold); and the level's rise and fall are limited.
#include <array>
#include <cstdint>

#include "device/host/strokes.h"
#include "device/protocol/calibration.h"
#include "device/protocol/report.h"

namespace ostium::device {

struct ClampSettings {
  std::array<double, tools> radius_m{1.0e-3, 0.18e-3, 0.5e-3, 0.18e-3};  ///< of each tool where it is clamped
  double most_N = 8;                                                     ///< whatever the simulation says
  double rise_N_s = 100, fall_N_s = 400;
  double reversal_mm = 0.3, reversal_deg = 6;  ///< movement the other way that changes the direction
  double smooth_s = 0.016;                     ///< time constant of the low pass of loads, 10 Hz
  double least_felt = 0.1;  ///< part of a load whose change a hand does not feel: the level rests there
  double least_push_N = 0.03, least_torque_Nm = 6e-5;  ///< the same, of any load; the torque on a torque device of 2 mm
  double settle_s = 0.2;  ///< a load that has changed is followed so long, then rests again
  double stale_s = 0.03;  ///< loads older than this open the clamps
};

/// On one instrument, from the step's RodReport: what its base is pushed and turned with.
struct ClampLoad {
  double push_N = 0, torque_Nm = 0;
};

/// The direction of a movement that wavers.
struct Direction {
  int sign = 0;  ///< 0: has not moved yet
  double turned_at = 0, position = 0;
};

/// A load as the clamp holds against it.
struct HeldLoad {
  double smooth = 0, held = 0;  ///< behind the low pass; the same, while it does not rest
  double followed_at = 0, follow_for_s = 0;
};

struct ClampState {
  std::array<Direction, tools> along{}, around{};
  std::array<HeldLoad, tools> push_N{}, torque_Nm{};
  std::array<double, tools> level_N{};
  std::uint16_t sequence = 0;      ///< of the last OUT report
  std::uint16_t arm_sequence = 0;  ///< of the one that raised ARM
  bool arm = false;                ///< as last sent
  bool stopped = false;            ///< the box was stopped: it is not armed again before `arm` was withdrawn
};

/// What the clamps are to do now.
struct ClampRequest {
  bool arm = false;  ///< the operator wants to feel forces
  std::array<ClampLoad, tools> load{};
  double load_age_s = 0;  ///< since the step that gave the loads
  bool paused = false;    ///< the simulation stands: clamps open, so that the operator can draw back
};

/// Advances each tool's level by the box's time between two reports. Loads that are not numbers count as zero. A tool
/// that is not seen is let go of at once.
void advance_clamps(const ClampSettings& settings, const ClampRequest& request, const Movements& movements,
                    ClampState& state);

/// The next OUT report: levels in parts of each track's full scale, and ARM, which is lowered and raised again if the
/// box has opened its clamps (watchdog).
OutReport clamp_report(const ClampRequest& request, const Calibration& calibration, const InReport& report,
                       ClampState& state);

}  // namespace ostium::device
