#pragma once
/// Replays a recorded run from its inputs alone; the script is not executed.
#include <functional>
#include <optional>

#include "app/session/run/run.h"
#include "app/session/scene/dose.h"
#include "data/assessment/metrics.h"
#include "data/recording/recording.h"

namespace ostium::app {

/// Throws LoadError unless a replay can begin at this second.
void require_within(const data::RecordingReader& recording, double second);

/// The state at the end of that many seconds, of a recording laid out as the model's; at 0 the one that this model
/// begins with. Throws LoadError if it is not the one that its hash was made of: its indices would lead anywhere.
void take_recorded_state(const data::RecordingReader& recording, const SessionModel& model, std::uint64_t seed,
                         std::size_t second, SessionState& state);

class Replay {
 public:
  /// Reads the recording and rebuilds its vessel and tools. Throws LoadError or MeshError. `vessel`: one made from the
  /// same setup; null: build it.
  explicit Replay(const std::string& file, std::shared_ptr<const Vessel> vessel = nullptr);

  /// Jumps to the last recorded state not later than this. Without recorded states only 0 is possible. Throws
  /// LoadError.
  void go_to(double second);
  /// One step of the recording. False: there are no more.
  bool tick();
  /// Counts the time of the phases of its steps; null: nobody does.
  void count_time(core::PhaseClock* clock) { scratch_.count_time(clock); }
  /// The run's X-ray use so far, including before the state that was jumped to.
  const XrayUse& xrays();

  const data::RecordingReader recording;
  const RunSetup setup;
  const SessionModel model;
  SessionState state;
  SessionInputs inputs;  ///< of the last step; before the first, of that
  SessionReport report;
  bool same = true;  ///< whether the last step's state matches the recording

 private:
  void look_at_inputs();
  void read_ahead();
  SessionScratch scratch_;
  static constexpr std::size_t ahead = 2000;
  std::size_t first_ = 0;  ///< step of the first row read
  std::vector<double> rows_;
  std::vector<std::uint64_t> hashes_;
  XrayUse xrays_;
  std::size_t xrays_to_ = 0;  ///< step up to which X-rays are counted
};

struct VerifyReport {
  std::size_t steps = 0;                  ///< compared
  std::optional<std::size_t> first_step;  ///< first that differs, counted from 1: the state after that many steps
  std::string field;                      ///< first field that differs at the next recorded state, "" if none
  std::size_t field_step = 0;             ///< step of that recorded state
};

/// Runs from the current position to the end, or to the next recorded state after the first difference.
VerifyReport verify(Replay& replay, const std::function<void(const Replay&)>& progress = {});

/// The record from which metrics are computed.
data::RunRecord record_of(const data::RecordingReader& recording, const SessionModel& model);

}  // namespace ostium::app
