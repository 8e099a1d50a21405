#pragma once
/// What goes wrong with the coronary wire. Its tip's way is judged along the artery, while the heart rests.
#include "app/session/handling/scene.h"
#include "app/session/session_event.h"

namespace ostium {

class WireErrors {
 public:
  void look(const HandlingMap& map, const HandlingScene& scene, const EventSink& say);

 private:
  void look_at_hand(const HandlingMap& map, const HandlingScene& scene, const EventSink& say);
  void look_at_place(const HandlingMap& map, const HandlingScene& scene, const EventSink& say);
  void look_at_drift(double along_m, const HandlingScene& scene, const EventSink& say);
  void look_at_loss(const HandlingMap& map, double along_m, const HandlingScene& scene, const EventSink& say);

  Episode side_, blind_, too_far_;
  Held too_far_for_;
  double fed_m_ = 0, blind_m_ = 0;
  double parked_m_ = -1;                            ///< where the tip was as a device began to move; -1: none does
  double farthest_m_ = -1, fed_at_farthest_m_ = 0;  ///< behind the lesion; -1: it is not across
};

}  // namespace ostium
