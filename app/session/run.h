#pragma once
/// One run of a script, step by step.
#include "app/session/setup.h"

namespace ostium {

class ScriptedRun {
 public:
  /// Throws LoadError, with the script's line where it is the script's fault.
  ScriptedRun(const RunSetup& setup, std::shared_ptr<const Vessel> vessel);

  /// The operator looks and decides; then one step, unless the script is at its end. False: it is.
  bool tick();

  const SessionModel model;
  const ScriptPlan plan;
  SessionState state;
  OperatorState hands;
  SessionInputs inputs;  ///< of the last step
  SessionReport report;
  std::vector<OperatorEvent> events;  ///< of the last tick
  Outcome outcome = Outcome::running;
  long troubled = 0;           ///< steps that had to give way, other than at an instrument's end
  std::uint32_t troubles = 0;  ///< what they gave way on, bits of Trouble

 private:
  SessionScratch scratch_;
};

/// "not_converged, motion_lost"
std::string trouble_words(std::uint32_t trouble);

}  // namespace ostium
