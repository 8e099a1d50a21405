/// The drive slips on the wire: of each turn a share does not arrive.
#include "data/identification/curves/torque_response/torque_response.h"

namespace ostium::data::torque_response {

Effect drive_slip() {
  Effect effect;
  effect.head.id = "drive_slip";
  effect.head.what = "a drive that slips";
  effect.head.parameters = {{"share", "1", "share of the turn that does not arrive", 0, 0.05, -0.3, 0.9, false}};
  effect.apply = [](const std::vector<double>& v, Setup& setup) { setup.slip = v[0]; };
  return effect;
}

}  // namespace ostium::data::torque_response
