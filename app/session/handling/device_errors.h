#pragma once
/// What goes wrong with balloons and stents.
#include "app/session/handling/scene.h"
#include "app/session/session_event.h"

namespace ostium {

class DeviceErrors {
 public:
  void look(const SessionModel& model, const SessionState& state, const HandlingScene& scene, const EventSink& say);

 private:
  Episode long_, ischaemic_, dragged_, beyond_;
  Held inflated_for_, shifted_for_;
  bool open_ = false;
  double opened_at_m_ = 0;  ///< what the hand had fed as it opened
};

}  // namespace ostium
