#pragma once
/// Handling errors: what an instructor would stop an operator for, found from what happens, each an event of
/// data/metrics.h with its definition and its severity. Limits are a draft for raters, as data/scoring is; none is
/// validated.
///
/// One more: its line in the table of data/events.cpp, where it is found in one of these files, an item in
/// data/scoring, a test (tests/app/session/handling_test.cpp).
#include "app/session/handling/catheter_errors.h"
#include "app/session/handling/device_errors.h"
#include "app/session/handling/wire_errors.h"

namespace ostium {

/// Part of the loop, not of the simulation. Allocates only while it is made, at its first look, and if events must
/// grow.
class HandlingWatch {
 public:
  static constexpr int every = 10;  ///< steps between looks

  explicit HandlingWatch(const SessionModel& model) : map_(model) {}
  void look(const SessionModel& model, const SessionInputs& inputs, const SessionState& state,
            const SessionReport& report, const EventSink& say);
  const HandlingScene& scene() const { return scene_; }  ///< of the last look

 private:
  void look_at_pushing(const SessionModel& model, const EventSink& say);
  void look_at_beam(const EventSink& say);

  HandlingMap map_;
  HandlingScene scene_;
  CatheterErrors catheter_;
  WireErrors wire_;
  DeviceErrors device_;
  struct Pushing {
    double fed_m = 0, along_m = 0, push_N = 0;  ///< as 15 mm of pushing began
  };
  std::vector<Pushing> pushing_;
  std::vector<Episode> stuck_;
  Held idle_for_;
  Episode idle_;
};

}  // namespace ostium
