#pragma once
/// What a trainer provokes and what answers it, as a console asks for them: give, infuse, drain, shock, provoke.
#include <deque>
#include <string>

#include "app/session/model/session.h"
#include "data/console/console_commands.h"

namespace ostium::app {

/// Empty if this patient can have it; else why not, with what could be. True of other commands, too.
std::string why_not(const SessionModel& model, const data::ConsoleOrder& order);

/// Orders as inputs: doses, shocks and provocations in one step, one after another; rates until they are changed.
class Emergency {
 public:
  /// False: another sort of command. What the patient cannot have is left out.
  bool take(const SessionModel& model, const data::ConsoleOrder& order);
  /// Onto what script or box ask for.
  void fill(DeliveryInputs& to);
  /// The run has gone back: rates as they were.
  void restart(const DeliveryInputs& inputs);

 private:
  std::deque<data::ConsoleOrder> once_;
  double infusion_m3_s_ = 0, drain_m3_s_ = 0;
  const vascular::FlowTree* tree_ = nullptr;
};

}  // namespace ostium::app
