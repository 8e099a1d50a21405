#pragma once
/// One run of a script, step by step.
#include <cstdint>
#include <vector>

#include "app/session/operator/setup.h"
#include "app/session/scene/dose.h"

namespace ostium::app {

class ScriptedRun;

enum class Driven { on, after_a_stand, over };

/// Moves the instruments instead of the script's operator, who keeps observing: for example hands at a tracking box.
class Driver {
 public:
  virtual ~Driver() = default;
  /// Called before each step. `inputs` holds what the script asks for; the driver changes it to what is done. Blocks
  /// while the simulation is to stand still.
  virtual Driven drive(const ScriptedRun& run, SessionInputs& inputs) = 0;
  /// Whether this moment has been marked since the last call.
  virtual bool marks() { return false; }
  /// Adds what else is to be recorded of this moment: a lesson's instructions and hints.
  virtual void remark(std::vector<OperatorEvent>& /*events*/) {}
  /// Whether the script waits meanwhile: somebody has taken over. It then begins its step anew.
  virtual bool holds_script() const { return false; }
};

/// Notes in `moved_at` which tools these inputs move in a step, counted from 1.
void note_moved(const SessionInputs& inputs, std::uint64_t step, std::vector<std::uint64_t>& moved_at);

class ScriptedRun {
 public:
  /// Throws LoadError, with the script's line if the script is at fault. `driver` must outlive this; null: the script
  /// moves the instruments.
  ScriptedRun(const RunSetup& setup, std::shared_ptr<const Vessel> vessel, Driver* driver = nullptr);

  /// Takes effect from the next step; null: the script moves the instruments.
  void take_over(Driver* driver) { driver_ = driver; }

  /// One decision of the operator, then one step. False: the script has ended.
  bool tick();
  /// One step of a recording, in which nobody decides anything.
  void repeat(const SessionInputs& recorded);

  const SessionModel model;
  const ScriptPlan plan;
  SessionState state;
  OperatorState hands;
  SessionInputs inputs;  ///< of the last step
  SessionReport report;
  std::vector<OperatorEvent> events;  ///< of the last tick
  Outcome outcome = Outcome::running;
  long troubled = 0;                    ///< steps with trouble flags, other than at an instrument's end
  std::uint32_t troubles = 0;           ///< their Trouble bits
  XrayUse xrays;                        ///< so far, whether drawn or not
  std::vector<std::uint64_t> moved_at;  ///< of each tool: the last step in which it was fed or turned; 0: none
  bool stood = false;                   ///< the driver made it stand still before the last step
  long overruns = 0;                    ///< steps that began over 1 ms late; counted by the pacing loop

 private:
  SessionScratch scratch_;
  void advance();
  bool held_ = false;  ///< the script waited in the last tick
  int stuck_ = -1;     ///< the tool with a failed drive
  Driver* driver_;
};

/// Why the operator ended it.
inline std::string reason(const ScriptedRun& run) {
  return reason(run.plan, run.model, run.state, run.report, run.hands);
}

/// "not_converged, motion_lost"
std::string trouble_words(std::uint32_t trouble);

}  // namespace ostium::app
