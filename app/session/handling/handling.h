#pragma once
/// Handling errors: what an instructor would stop an operator for, found from what happens, each an event of
/// data/assessment/events.def with its definition and its severity. Limits are a draft for raters, as data/scoring is;
/// none is validated.
///
/// One more: its row in data/assessment/events.def, its class in the file of its group (errors.h), an item in
/// data/scoring, a test (tests/app/session/handling_test.cpp).
#include <memory>

#include "app/session/handling/scene.h"
#include "app/session/handling/session_event.h"

namespace ostium::app {

struct HandlingErrors;

/// Part of the loop, not of the simulation. Allocates only while it is made, at its first look, and if events must
/// grow.
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
