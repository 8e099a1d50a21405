#pragma once
/// The driver of a run that somebody watches: it shows the run to windows and browsers, and does what their console
/// asks. All that it does to the simulation is SessionInputs, so a recording of it replays like any other.
#include <atomic>
#include <cmath>
#include <string>
#include <vector>

#include "app/session/live/checklist.h"
#include "app/session/live/console.h"
#include "app/session/recorder/signals.h"
#include "app/session/run/run.h"
#include "core/base/triple_buffer.h"

namespace ostium::app {

inline constexpr int strip_samples = 500;  ///< at 100 a second

/// The run as a window shows it. Copied whole at every frame.
struct Snapshot {
  SessionState state;
  SessionInputs inputs;
  XrayUse xrays;                         ///< by then, drawn or not
  std::vector<ToolReport> tools;         ///< (#tools)
  std::vector<core::Touch> touches;      ///< of walls
  std::vector<float> signals;            ///< as signal_names says
  std::vector<float> ecg_mV, line_mmHg;  ///< of the last 5 s, oldest first; not a number: no trace
  /// The guide's pressure, lowest and highest, in its last complete beat; not a number: no trace, as in an injection.
  double guide_low_mmHg = NAN, guide_high_mmHg = NAN;
  PictureSettings picture;
  int right_hand = -1;  ///< tool
  int script_step = -1;
  int refused = -1, in_its_way = -1;  ///< tools, of the last second
  int marks = 0;                      ///< set by then
  double marked_s = 0;                ///< when the last was
  Hands hands = Hands::script;
  bool paused = false;
  int begun = 0;  ///< how often the run has gone back
  long overruns = 0;
};

class LiveDriver : public Driver {
 public:
  /// `hands`: who moves the instruments at first. `inner`: another driver (a tracking box) that is asked first; may be
  /// null. A script may be taken over from, and handed back to.
  LiveDriver(const SessionModel& model, Hands hands, double frames_per_s, Driver* inner = nullptr);

  Driven drive(const ScriptedRun& run, SessionInputs& inputs) override;
  bool marks() override;
  void remark(std::vector<OperatorEvent>& events) override;
  bool holds_script() const override { return hands_ == Hands::seats && began_as_ == Hands::script; }
  /// Between two plays: the run has gone back to this moment.
  void restart(const ScriptedRun& run);

  Controls& controls(Seat seat) { return console_.controls[static_cast<std::size_t>(seat)]; }
  core::TripleBuffer<Snapshot>& snapshots(Seat seat) { return snapshots_[static_cast<std::size_t>(seat)]; }
  /// Before the run: it ends when that becomes true, even while it stands paused. It must outlive the run.
  void end_on(const std::atomic<bool>& asked) { asked_to_end_ = &asked; }
  /// Before the run: from then on its snapshots are filled, too. The window's always are.
  void show_to(Seat seat) { shown_to_[static_cast<std::size_t>(seat)] = true; }
  /// Before the run: these instructions are looked at as it goes; they must outlive it.
  void follow(Checklist* checklist) { checklist_ = checklist; }
  /// From any thread: a hint on that instruction is recorded with the next step.
  void hinted(int instruction) { hinted_ = instruction; }
  /// Who moved the instruments at first.
  Hands began_as() const { return began_as_; }
  /// The guide, or the first tool.
  int left_hand() const { return console_.left_hand(); }

 private:
  void act(const SessionModel& model, const ConsoleOrder& order);
  void read_pressure(const SessionModel& model, const SessionState& state);
  void read_traces(const ScriptedRun& run, const SessionInputs& inputs);
  void show(const ScriptedRun& run, const SessionInputs& inputs);

  Hands hands_, began_as_;
  double frames_per_s_;
  Driver* inner_;
  Console console_;
  bool paused_ = false, over_ = false, marks_ = false;
  int begun_ = 0;
  int line_count_ = 0;
  double line_low_Pa_ = -1e6, line_high_Pa_ = 0;  ///< of the beat that goes on
  double guide_low_mmHg_ = NAN, guide_high_mmHg_ = NAN;
  int refused_ = -1, in_its_way_ = -1;
  std::uint64_t refused_at_ = 0;
  const std::atomic<bool>* asked_to_end_ = nullptr;
  Checklist* checklist_ = nullptr;
  std::atomic<int> hinted_{-1};
  int marked_ = 0;
  std::uint64_t marked_at_ = 0, step_ = 0;
  std::size_t ecg_at_, line_at_;
  std::vector<float> row_, ecg_, line_;
  std::array<core::TripleBuffer<Snapshot>, seats> snapshots_;
  std::array<bool, seats> shown_to_{true, false};
};

}  // namespace ostium::app
