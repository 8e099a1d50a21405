#pragma once
/// Detects a run's events by comparing each step with the one before. Part of the loop, not of the simulation: replay
/// does not need it.
#include <array>
#include <vector>

#include "app/session/handling/handling.h"
#include "app/session/operator/operator.h"
#include "app/session/recorder/settled_branch.h"

namespace ostium::app {

data::EventCode event_code(OperatorEvent::Kind kind);

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
    double wall_force_N = 0;  ///< low-pass filtered as for the metrics
    double eased_s = 0;       ///< how long it has been well below the limit
  };
  void look_at_tools(const SessionModel& model, const SessionReport& report, std::uint64_t now, bool handling_looked,
                     const EventSink& say);
  void look_at_beam(const CArmInputs& arm, const EventSink& say);
  void look_at_syringe(const SessionInputs& inputs, const SessionState& state, const EventSink& say);
  void look_at_heart(const SessionState& state, const EventSink& say);
  void look_at_patient(const SessionModel& model, const SessionState& state, const EventSink& say);
  void look_at_care(const SessionModel& model, const SessionInputs& inputs, const SessionState& state,
                    const EventSink& say);
  void look_at_clots(const SessionState& state, const EventSink& say);
  void look_at_awareness(const SessionState& state, double time_s, const EventSink& say);
  void look_at_balloon(const SessionModel& model, const SessionInputs& inputs, const SessionState& state,
                       const EventSink& say);
  void look_at_stents(const SessionModel& model, const SessionState& state, const EventSink& say);
  void look_at_flow(const SessionModel& model, const SessionState& state, const EventSink& say);
  void look_at_injuries(const SessionState& state, double time_s, const EventSink& say);
  void look_at_entry(const SessionReport& report, const EventSink& say);

  // Values at the step before:
  std::vector<Tool> tools_;
  HandlingWatch handling_;
  std::vector<vascular::StentState::Where> stents_;  ///< where each was
  std::array<double, vascular::most_injuries> injuries_{};
  struct WatchedBalloon {
    bool inflated = false, filled = false, over = false, burst = false;
    double inflated_since_s = 0;
  };
  std::array<WatchedBalloon, vascular::most_balloons> balloons_;
  bool injects_ = false, closed_ = false;
  double closed_since_s_ = 0;
  bool leaks_ = false, leaked_ = false, low_ = false, pulseless_ = false, drains_ = false, infuses_ = false,
       compressed_ = false, paced_ = false, draws_ = false;
  bool hurts_ = false, awake_ = true;
  double hurts_since_s_ = 0, fainted_s_ = 0;
  int thrombi_ = 0;
  double embolised_m3_ = 0, aspirated_m3_ = 0, air_m3_ = 0, line_air_m3_ = 0;
  double compressed_since_s_ = 0;
  double leaks_since_s_ = 0, leak_seen_s_ = 0, pulseless_since_s_ = 0, perforated_s_ = -1;
  vascular::Rhythm rhythm_ = vascular::Rhythm::sinus;
  bool ectopic_ = false;
  vascular::Trace trace_ = vascular::Trace::absent;
  int refused_ = -1;
  bool fluoroscopy_ = false, cine_ = false;
  std::uint32_t trouble_ = 0;
};

}  // namespace ostium::app
