#pragma once
/// One run of a script, step by step.
#include "app/session/operator/setup.h"
#include "app/session/scene/dose.h"

namespace ostium::app {

class ScriptedRun;

enum class Driven { on, after_a_stand, over };

/// Drives the instruments instead of the script's operator, who goes on looking: real hands at a tracking box.
class Driver {
 public:
  virtual ~Driver() = default;
  /// Before each step. `inputs` is what the script asks for, and becomes what is done. Waits while the simulation is to
  /// stand.
  virtual Driven drive(const ScriptedRun& run, SessionInputs& inputs) = 0;
};

class ScriptedRun {
 public:
  /// Throws LoadError, with the script's line where it is the script's fault. `driver` must live as long; null: the
  /// script moves the instruments.
  ScriptedRun(const RunSetup& setup, std::shared_ptr<const Vessel> vessel, Driver* driver = nullptr);

  /// From the next step on; null: the script moves the instruments.
  void take_over(Driver* driver) { driver_ = driver; }

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
  XrayUse xrays;               ///< so far, drawn or not
  bool stood = false;          ///< the driver let it stand before the last step
  long overruns = 0;           ///< steps that began over 1 ms late; whoever paces the run counts them

 private:
  SessionScratch scratch_;
  int stuck_ = -1;  ///< the tool whose drive is out
  Driver* driver_;
};

/// "not_converged, motion_lost"
std::string trouble_words(std::uint32_t trouble);

}  // namespace ostium::app
