#pragma once
/// The loop around a run: pace, recording, times, the end.
#include <atomic>
#include <functional>
#include <memory>

#include "app/session/recorder/recorder.h"
#include "app/session/run/run.h"
#include "app/session/scene/dose.h"

namespace ostium::app {

struct PlayOptions {
  RecorderOptions recorder;
  /// One step a millisecond of the clock, and where one takes longer the next ones follow sooner until it is caught up
  /// with; else as fast as it goes, with the same result.
  bool real = false;
  double seconds = 0;    ///< most that are simulated; 0: no end but the script's
  double give_up_s = 0;  ///< of the clock; 0: never
  /// Called now and then, at least every 0.1 s simulated: for progress. May be empty.
  std::function<void(const ScriptedRun&)> progress;
  std::shared_ptr<const Dosimeter> dosimeter;  ///< of the vessel, where many runs share it; null: made if needed
  const std::atomic<bool>* stop = nullptr;     ///< becomes true: the run ends as aborted
};

/// CPU time of the thread that steps: operator, step, hash, recording.
struct StepTimes {
  double mean_ms = 0, p50_ms = 0, p99_ms = 0, p999_ms = 0, most_ms = 0;
  long overruns = 0;          ///< steps that began over 1 ms late, with `real`
  double behind_most_ms = 0;  ///< the clock, with `real`
};

struct PlayReport {
  std::string outcome, reason;
  double simulated_s = 0, clock_s = 0;
  StepTimes times;
  std::vector<data::Metric> metrics;
  Penetration penetration;
  std::string problem;  ///< of the recording
  long waits = 0;
  std::uint64_t hash = 0;  ///< of the last state
};

/// Runs to the end. Throws LoadError if the recording cannot be begun; what goes wrong with it later is in `problem`.
PlayReport play(ScriptedRun& run, const RunSetup& setup, const PlayOptions& options);

}  // namespace ostium::app
