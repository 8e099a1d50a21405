#pragma once
/// Records a run without slowing it down, and measures wall penetration once a second.
///
/// The simulation thread fills preallocated blocks and hands them over five times a second without a lock; another
/// thread owns the file. If that thread falls behind by all blocks, the simulation waits and `waits` counts it: nothing
/// of a run is lost.
#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <thread>

#include "app/session/model/penetration.h"
#include "app/session/operator/setup.h"
#include "app/session/recorder/event_watch.h"
#include "app/session/recorder/signals.h"
#include "data/assessment/metrics.h"
#include "data/recording/recording.h"

namespace ostium::app {

enum class RecordMode { none, events, full };

/// A recording goes on where another one was at a whole second.
struct Continued {
  std::string file;       ///< the other one; finished
  std::size_t steps = 0;  ///< a multiple of data::steps_per_state
};

struct RecorderOptions {
  RecordMode mode = RecordMode::full;
  std::string file;         ///< empty if RecordMode::none
  bool penetration = true;  ///< measure it once a second
  double shapes_Hz = 0;     ///< how often the tools' nodes are recorded, to the nearest whole number of steps; 0: never
  std::optional<Continued> continues = {};  ///< then `begin` is not called
  std::shared_ptr<EventWatch> watch = {};   ///< that has seen the seconds before
  /// Told of each event by the thread that steps; must not wait for anything. May be empty.
  std::function<void(const SessionEvent&)> heard = {};
  /// Told by the thread that writes, once, why nothing more of the run is recorded. May be empty.
  std::function<void(const std::string&)> failed = {};
};

class Recorder {
 public:
  /// Throws WriteError or LoadError if the file cannot be created.
  Recorder(const RecorderOptions& options, const SessionModel& model, const RunSetup& setup,
           std::size_t operator_count);
  ~Recorder();  ///< ends the thread; blocks already handed over are written

  /// Call with the initial state, before the first step.
  void begin(const SessionState& state, const OperatorState& hands);
  /// Call after each step.
  void add(const SessionInputs& inputs, const SessionState& state, const SessionReport& report,
           const OperatorState& hands, const std::vector<OperatorEvent>& script);
  /// Call when no step follows, with what the operator did then: it is of the last step.
  void end(const SessionState& state, const std::vector<OperatorEvent>& script);
  /// Hands over the last block and waits for the thread.
  void stop();
  /// After `stop`: writes the end of the run. Throws LoadError if it cannot be written.
  void finish(const std::string& end);

  // After `stop`:
  const data::RunRecord& record() const { return record_; }  ///< of the whole run
  const Penetration& penetration() const { return deepest_; }
  const std::string& problem() const { return problem_; }  ///< why recording ended early; empty if it did not
  long waits() const { return waits_; }

 private:
  struct Slot {
    data::RecordingBlock block;
    std::vector<float> shapes_m;  ///< one row per shape row, of all tools
    std::size_t steps = 0, signal_rows = 0, state_rows = 0, shape_rows = 0;
    std::vector<SessionEvent> events;
  };
  static constexpr std::size_t slots = 10;  ///< 2 s

  Slot& current() { return slots_[filled_.load(std::memory_order_relaxed) % slots]; }
  void put_state(const SessionState& state, const OperatorState& hands);
  void put_shape(const SessionState& state);
  void part_shapes(const Slot& slot, data::RecordingBlock& block) const;
  void hand_over();
  void take_before(const Continued& before);
  void follow();
  void take(Slot& slot);
  void look(const Slot& slot, std::vector<double>& events);

  const SessionModel& model_;
  RecorderOptions options_;
  std::size_t input_width_, signal_width_, state_width_, operator_width_, shape_width_;
  std::size_t shape_every_ = 0;  ///< steps; 0: never
  std::vector<Slot> slots_;
  std::atomic<std::size_t> filled_{0}, taken_{0};
  std::atomic<bool> over_{false};
  long waits_ = 0;
  std::shared_ptr<EventWatch> watch_;
  // Used by the writing thread:
  std::unique_ptr<data::RecordingWriter> writer_;
  SessionState looked_at_;
  data::RunRecord record_;
  Penetration deepest_;
  double ffr_ = -1;  ///< last reported
  std::string problem_;
  std::thread thread_;
};

}  // namespace ostium::app
