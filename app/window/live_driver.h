#pragma once
/// The driver of a run that somebody watches: it shows the run to the window and, if they play, moves the instruments
/// as they ask. All that it does to the simulation is SessionInputs, so a recording of it replays like any other.
#include <atomic>
#include <cmath>
#include <string>
#include <vector>

#include "app/session/recorder/signals.h"
#include "app/session/run/run.h"
#include "app/window/controls.h"
#include "core/base/triple_buffer.h"

namespace ostium::app {

/// Speeds of hands at a keyboard.
inline constexpr double hand_feed_m_s = 0.03, hand_turn_rad_s = 3.14, fine_share = 1.0 / 6;
inline constexpr double hand_contrast_m3_s = 4e-6, hand_flush_m3_s = 4e-6;

inline constexpr int strip_samples = 500;  ///< at 100 a second

/// The run as the window shows it. Copied whole at every frame.
struct Snapshot {
  SessionState state;
  SessionInputs inputs;
  XrayUse xrays;                         ///< by then, drawn or not
  std::vector<char> in_body;             ///< (#tools)
  std::vector<float> signals;            ///< as signal_names says
  std::vector<float> ecg_mV, line_mmHg;  ///< of the last 5 s, oldest first; not a number: no trace
  /// The guide's pressure, lowest and highest, in its last complete beat; not a number: no trace, as in an injection.
  double guide_low_mmHg = NAN, guide_high_mmHg = NAN;
  int right_hand = -1;  ///< tool
  int script_step = -1;
  int refused = -1, in_its_way = -1;  ///< tools, of the last second
  bool paused = false;
  long overruns = 0;
};

class LiveDriver : public Driver {
 public:
  /// `plays`: the controls move the instruments; else the script does, and the controls only pause and end.
  /// `inner`: another driver (a tracking box) that is asked first; may be null.
  LiveDriver(const SessionModel& model, bool plays, double frames_per_s, Driver* inner = nullptr);

  Driven drive(const ScriptedRun& run, SessionInputs& inputs) override;
  bool marks() override;

  Controls controls;
  core::TripleBuffer<Snapshot>& snapshots() { return snapshots_; }
  /// The guide, or the first tool.
  int left_hand() const { return left_; }

 private:
  void act(const SessionModel& model, Action action);
  void read_pressure(const SessionModel& model, const SessionState& state);
  void play(const SessionModel& model, SessionInputs& inputs);
  void show(const ScriptedRun& run, const SessionInputs& inputs);

  bool plays_;
  double frames_per_s_;
  Driver* inner_;
  int left_ = 0, right_ = -1;
  CArmInputs arm_;
  bool arm_is_set_ = false;
  double gauge_Pa_ = 0, heparin_U_ = 0, nitrate_ug_ = 0;
  bool paused_ = false, over_ = false, marks_ = false;
  int line_count_ = 0;
  double line_low_Pa_ = -1e6, line_high_Pa_ = 0;  ///< of the beat that goes on
  double guide_low_mmHg_ = NAN, guide_high_mmHg_ = NAN;
  int refused_ = -1, in_its_way_ = -1;
  std::uint64_t refused_at_ = 0;
  std::size_t ecg_at_, line_at_;
  std::vector<float> row_, ecg_, line_;
  core::TripleBuffer<Snapshot> snapshots_;
};

}  // namespace ostium::app
