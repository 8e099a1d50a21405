#pragma once
/// Handling errors: mistakes for which an instructor would stop an operator, detected during the run; each is an event
/// of data/assessment/events.def with definition and severity. The limits are a draft for raters, as is data/scoring;
/// none is validated.
///
/// To add one: a row in data/assessment/events.def, a class in the file of its group (errors.h), an item in
/// data/scoring and a test (tests/app/session/handling_test.cpp).
#include <memory>

#include "app/session/handling/scene.h"
#include "app/session/handling/session_event.h"

namespace ostium::app {

struct HandlingErrors;

/// Part of the loop, not of the simulation. Allocates only when constructed, at its first look, and when the events
/// must grow.
class HandlingWatch {
 public:
  static constexpr int every = 10;  ///< steps between looks

  explicit HandlingWatch(const SessionModel& model);
  ~HandlingWatch();
  void look(const SessionModel& model, const SessionInputs& inputs, const SessionState& state,
            const SessionReport& report, const EventSink& say);
  const HandlingScene& scene() const { return scene_; }  ///< of the last look

 private:
  HandlingMap map_;
  HandlingScene scene_;
  std::unique_ptr<HandlingErrors> errors_;
};

}  // namespace ostium::app
