/// Under pressure the balloon grows with time: its size by a share of the integral of pressure over the run.
#include "data/identification/curves/pressure_diameter/pressure_diameter.h"

namespace ostium::data::pressure_diameter {

Effect creep() {
  Effect effect;
  effect.head.id = "creep";
  effect.head.what = "a balloon that grows with time";
  effect.head.parameters = {{"per_min_atm", "1/(min atm)", "share by which it grows", 0.001, 0.002, 0, 0.05, false}};
  effect.apply = [](const std::vector<double>& v, Setup& setup) { setup.creep_per_Pa_s += v[0] / 60 / 101325; };
  return effect;
}

}  // namespace ostium::data::pressure_diameter
