#pragma once
/// The instructions of a lesson, ticked as they happen: by conditions, as an operator sees them, or by events. All of
/// it on the thread that steps. What is ticked becomes an event of the recording, from which it is known again.
#include <optional>
#include <vector>

#include "app/session/handling/session_event.h"
#include "app/session/run/run.h"
#include "data/assessment/events.h"
#include "data/catalogue/course/course.h"

namespace ostium::app {

class Checklist {
 public:
  /// `script`: the lesson's, whose tools and landmarks the conditions name. Throws LoadError with the course's file and
  /// line for a place or an event that there is not.
  Checklist(const std::vector<data::Instruction>& instructions, const data::Script& script, const SessionModel& model);

  /// Call now and then, between two steps.
  void look(const ScriptedRun& run);
  /// An event has come.
  void hear(const SessionEvent& event);
  /// Adds those that have been done since the last call.
  void take_done(std::vector<OperatorEvent>& events);
  /// The run stands at this moment of its past, by when these events had come.
  void go_back(const std::vector<SessionEvent>& before);

 private:
  struct Item {
    std::optional<data::EventCode> event;
    int after = -1;  ///< the item that must be done before it
    bool ticks = false, done = false, told = false, began = false;
    double began_s = 0, began_beats = 0;
    std::vector<double> began_fed_m, began_turned_rad;
  };
  bool is_its_turn(const Item& item) const {
    return item.after < 0 || items_[static_cast<std::size_t>(item.after)].done;
  }
  void begin(Item& item, const ScriptedRun& run) const;

  ScriptPlan plan_;  ///< a step for each instruction
  std::vector<Item> items_;
  OperatorState looking_;
};

/// The event of this name; none: there is none.
std::optional<data::EventCode> event_called(const std::string& name);

}  // namespace ostium::app
