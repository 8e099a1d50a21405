/// The load cell drifts in proportion to the time since the first run began.
#include "data/identification/curves/three_point_bend/three_point_bend.h"

namespace ostium::data::three_point_bend {

Effect force_drift() {
  Effect effect;
  effect.head.id = "force_drift";
  effect.head.what = "a load cell that drifts";
  effect.head.parameters = {{"mN_per_min", "mN/min", "its drift", 0, 5, -200, 200, false}};
  effect.apply = [](const std::vector<double>& v, Setup& setup) { setup.drift_N_per_s += v[0] * 1e-3 / 60; };
  return effect;
}

}  // namespace ostium::data::three_point_bend
