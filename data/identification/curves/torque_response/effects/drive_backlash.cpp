/// The drive has play: after each reversal it turns alone by a dead band before the wire follows. How much of the band
/// is still to be taken up when a run begins depends on how it was left.
#include "core/base/units.h"
#include "data/identification/curves/torque_response/torque_response.h"

namespace ostium::data::torque_response {

Effect drive_backlash() {
  Effect effect;
  effect.head.id = "drive_backlash";
  effect.head.what = "play of the drive at each reversal";
  effect.head.parameters = {
      {"dead_deg", "deg", "angle by which the drive turns alone", 8, 1, 0.1, 180, true},
      {"at_start", "1", "share of it that is left when a run begins", 0.3, 0.4, -0.3, 1.3, false}};
  effect.apply = [](const std::vector<double>& v, Setup& setup) {
    setup.dead_rad = v[0] * units::degree, setup.dead_at_start = v[1];
  };
  return effect;
}

}  // namespace ostium::data::torque_response
