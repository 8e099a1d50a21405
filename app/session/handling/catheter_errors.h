#pragma once
/// What goes wrong with guides, and with the thick wire that leads them.
#include <array>

#include "app/session/handling/scene.h"
#include "app/session/session_event.h"

namespace ostium {

class CatheterErrors {
 public:
  /// `trace`: the guide's pressure of the last beat.
  void look(const HandlingMap& map, const HandlingScene& scene, Trace trace, const EventSink& say);

 private:
  void look_at_lead(const HandlingMap& map, const HandlingScene& scene, const EventSink& say);
  void look_at_twist(const HandlingScene& scene, const EventSink& say);
  void look_at_seat(const HandlingMap& map, const HandlingScene& scene, Trace trace, const EventSink& say);
  void look_at_thick_wire(const HandlingMap& map, const HandlingScene& scene, const EventSink& say);

  Episode naked_, wound_, whip_, deep_, bad_trace_, astray_, in_ventricle_, in_coronary_;
  Held wound_for_, deep_for_, bad_trace_for_, ventricle_for_;
  int catheter_ = -1;  ///< that what follows is of
  double naked_m_ = 0, inserted_m_ = 0;
  std::array<double, 30> twists_{};  ///< the last 0.3 s, a number every look
  std::size_t looks_ = 0;
};

}  // namespace ostium
