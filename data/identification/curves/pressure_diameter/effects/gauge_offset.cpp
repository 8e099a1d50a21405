/// The pressure gauge was not zeroed: true pressures are those shown, and a constant. An inflation
/// device is good to about 3 % of its 30 atm.
#include "data/identification/curves/pressure_diameter/pressure_diameter.h"

namespace ostium::data::pressure_diameter {

Effect gauge_offset() {
  Effect effect;
  effect.head.id = "gauge_offset";
  effect.head.what = "a pressure gauge that was not zeroed";
  effect.head.parameters = {{"atm", "atm", "true pressure minus that shown", 0, 1, -4, 4, false}};
  effect.head.confused_with = "chart_offset";
  effect.apply = [](const std::vector<double>& v, Setup& setup) { setup.gauge_Pa += v[0] * 101325; };
  return effect;
}

}  // namespace ostium::data::pressure_diameter
