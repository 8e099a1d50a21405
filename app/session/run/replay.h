#pragma once
/// A recorded run once more, from its inputs alone: the script is not run again.
#include <functional>
#include <optional>

#include "app/session/run/run.h"
#include "app/session/scene/dose.h"
#include "data/assessment/metrics.h"
#include "data/recording/recording.h"

namespace ostium::app {

class Replay {
 public:
  /// Reads the recording and makes its vessel and tools anew. Throws LoadError, MeshError. `vessel`: one that was made
  /// of the same setup; null: make it.
  explicit Replay(const std::string& file, std::shared_ptr<const Vessel> vessel = nullptr);

  /// Goes to the last recorded state that is not later than this. Without recorded states: only 0. Throws LoadError.
  void go_to(double second);
  /// One step of the recording. False: there are no more.
  bool tick();
  /// What the run has used by now, also before a state that was gone to.
  const XrayUse& xrays();

  const data::RecordingReader recording;
  const RunSetup setup;
  const SessionModel model;
  SessionState state;
  SessionInputs inputs;  ///< of the last step
  SessionReport report;
  bool same = true;  ///< whether the last step's state was the recorded one

 private:
  void read_ahead();
  SessionScratch scratch_;
  static constexpr std::size_t ahead = 2000;
  std::size_t first_ = 0;  ///< step of the first row that was read
  std::vector<double> rows_;
  std::vector<std::uint64_t> hashes_;
  XrayUse xrays_;
  std::size_t xrays_to_ = 0;  ///< step
};

struct VerifyReport {
  std::size_t steps = 0;                  ///< compared
  std::optional<std::size_t> first_step;  ///< that differs, counted from 1: the state after so many steps
  std::string field;                      ///< that differs at the next recorded state, "" if there is none
  std::size_t field_step = 0;             ///< which that is
};

/// Runs from where `replay` is to the end, or to the next recorded state behind the first difference.
VerifyReport verify(Replay& replay, const std::function<void(const Replay&)>& progress = {});

/// The record that metrics are made of.
data::RunRecord record_of(const data::RecordingReader& recording, const SessionModel& model);

}  // namespace ostium::app
