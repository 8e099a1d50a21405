#pragma once
/// A session that no script drives: whoever calls steps it, a learner or a program in Python. What many of a model can
/// share, they share.
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "app/session/model/input_ranges.h"
#include "app/session/model/session.h"

namespace ostium::app {

/// A model, and scratch for as many of its runs as are being stepped at once.
class FreeRunModel {
 public:
  /// `seed`: of the beginning, where a run has none of its own.
  explicit FreeRunModel(SessionModel model, std::uint64_t seed = 0);

  const SessionModel session;
  const std::uint64_t seed;
  const SessionInputs at_rest;
  const std::vector<std::string> input_names, signal_names;
  const std::vector<InputRange> ranges;  ///< (#inputs)
  std::size_t state_count() const { return state_count_; }

  /// The initial state of a seed. Several threads may ask at once.
  SessionState beginning(std::uint64_t of_seed) const;

  /// Scratch, given back at the end of its life. The one with the number `preferred` if it is free: its wall is likely
  /// to be the right one. Several threads may take some at once.
  class Borrowed {
   public:
    Borrowed(const FreeRunModel& from, int preferred);
    ~Borrowed();
    Borrowed(const Borrowed&) = delete;
    SessionScratch& scratch() { return *scratch_; }
    int number() const { return number_; }

   private:
    const FreeRunModel& from_;
    int number_;
    std::unique_ptr<SessionScratch> scratch_;
  };

 private:
  mutable std::mutex mutex_;
  mutable std::vector<std::unique_ptr<SessionScratch>> scratches_;  ///< null: on loan
  std::size_t state_count_;
};

/// What an operator could measure on a tool.
struct ToolForces {
  double push_N = 0, torque_Nm = 0, wall_N = 0, tip_N = 0;
};

/// Not for two threads at once.
class FreeRun {
 public:
  static constexpr int steps_unasked = 100;

  explicit FreeRun(std::shared_ptr<const FreeRunModel> model);
  FreeRun(const FreeRun& other);

  /// To the beginning of a seed.
  void reset(std::uint64_t seed);
  /// `count` steps with the inputs of `row`; doses are given by the first. Afterwards signals, forces, peaks and
  /// trouble are those of these steps. Throws std::invalid_argument, and does nothing, where an input is out of its
  /// range.
  /// `stop`: asked every `steps_unasked` steps; true: those so far were all.
  void step(int count, const std::function<bool()>& stop = {});
  /// To a state of the same model (put_state); the model's count.
  void set_state(const double* numbers);

  const std::shared_ptr<const FreeRunModel> model;
  SessionState state;
  std::vector<double> row;  ///< inputs of the next steps
  std::vector<float> signals;
  std::vector<ToolForces> forces;  ///< (#tools), after the last step
  std::vector<ToolForces> peaks;   ///< (#tools), the largest magnitudes of the last call
  std::uint32_t trouble = 0;       ///< bits of core::Trouble in the last call
  double deepest_m = 0;            ///< in the last call, by contact's own planes (StepReport)

 private:
  void look();

  SessionInputs inputs_;
  SessionReport report_;
  int scratch_ = -1;
};

}  // namespace ostium::app
