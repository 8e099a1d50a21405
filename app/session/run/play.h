#pragma once
/// The loop around a run: pacing, recording, timing, the end.
#include <atomic>
#include <functional>
#include <memory>

#include "app/session/recorder/recorder.h"
#include "app/session/run/run.h"
#include "app/session/scene/dose.h"

namespace ostium::app {

struct PlayOptions {
  /// Where it continues another recording, the run has gone back to that second (branch.h).
  RecorderOptions recorder;
  /// true: one step per millisecond of clock time; after a slow step the next ones follow faster until it has caught
  /// up. false: as fast as possible, with the same result.
  bool real = false;
  double seconds = 0;           ///< limit of simulated time; 0: none but the script's end
  double give_up_s = 0;         ///< limit of clock time; 0: none
  std::function<void()> begun;  ///< called once, when the recording has begun. May be empty
  /// Called at least every 0.1 s of simulated time, for progress. May be empty.
  std::function<void(const ScriptedRun&)> progress;
  std::shared_ptr<const Dosimeter> dosimeter;  ///< of the vessel, if shared by many runs; null: made if needed
  const std::atomic<bool>* stop = nullptr;     ///< becomes true to abort the run
};

/// CPU time of the simulation thread: operator, step, hash, recording.
struct StepTimes {
  double mean_ms = 0, p50_ms = 0, p99_ms = 0, p999_ms = 0, most_ms = 0;
  long overruns = 0;          ///< steps that began over 1 ms late, with `real`
  double behind_most_ms = 0;  ///< largest delay against the clock, with `real`
};

struct PlayReport {
  std::string outcome, reason;
  double simulated_s = 0, clock_s = 0;
  StepTimes times;
  std::vector<data::Metric> metrics;
  /// By an independent judge: once a second and, unless in real time, where contact says that it is deep.
  Penetration penetration;
  double deepest_m = 0, deepest_s = 0;  ///< of all steps, by contact's own planes or the judge; and when
  std::string problem;                  ///< of the recording
  long waits = 0;
  std::uint64_t hash = 0;  ///< of the last state
};

/// Runs to the end. Throws WriteError or LoadError if the recording cannot be started; later recording errors are in
/// `problem`.
PlayReport play(ScriptedRun& run, const RunSetup& setup, const PlayOptions& options);

}  // namespace ostium::app
