#pragma once
/// What a recording shows of a run a hundred times a second, and the events in it: both are looked at by metrics, by
/// people and by debriefing, and neither is needed for replay.
#include <array>
#include <string>
#include <vector>

#include "app/session/handling/handling.h"
#include "app/session/operator.h"
#include "app/session/settled_branch.h"

namespace ostium {

std::size_t signal_count(const SessionModel& model);
std::vector<std::string> signal_names(const SessionModel& model);  ///< "wire.tip_x_mm"
/// `row` has signal_count numbers. Does not allocate.
void put_signals(const SessionModel& model, const SessionState& state, const SessionInputs& inputs,
                 const SessionReport& report, float* row);

/// Finds events by comparing a step with the one before; remembers what it needs for that. Part of the loop, not of the
/// simulation: replay does without.
class EventWatch {
 public:
  explicit EventWatch(const SessionModel& model);
  /// Appends to `events`; allocates only if that must grow.
  void look(const SessionModel& model, const SessionInputs& inputs, const SessionState& state,
            const SessionReport& report, const std::vector<OperatorEvent>& script, std::vector<SessionEvent>& events);

 private:
  struct Tool {
    bool in_body = false, pressed = false;
    SettledBranch branch;
    double wall_force_N = 0;  ///< behind the low pass that metrics use
  };
  std::vector<Tool> tools_;
  void look_at_patient(const SessionModel& model, const SessionInputs& inputs, const SessionState& state,
                       const SessionReport& report, const EventSink& say);

  HandlingWatch handling_;
  std::vector<StentState::Where> stents_;  ///< where they were
  std::array<double, most_injuries> injuries_{};
  bool injects_ = false, inflated_ = false, filled_ = false, over_ = false, closed_ = false;
  double inflated_since_s_ = 0, closed_since_s_ = 0;
  bool ectopic_ = false, burst_ = false;
  Trace trace_ = Trace::absent;
  int refused_ = -1;
  bool fluoroscopy_ = false, cine_ = false;
  std::uint32_t trouble_ = 0;
};

}  // namespace ostium
