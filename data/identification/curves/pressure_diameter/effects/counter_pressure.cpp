/// The vessel, or what lies around it, presses with a pressure of its own wherever the balloon touches it: the lumen
/// opens only beyond it.
#include "data/identification/curves/pressure_diameter/pressure_diameter.h"

namespace ostium::data::pressure_diameter {

Effect counter_pressure() {
  Effect effect;
  effect.head.id = "counter_pressure";
  effect.head.what = "a vessel that presses more than declared";
  effect.head.parameters = {{"atm", "atm", "the pressure by which it presses more", 0.5, 1, 0.01, 10, true}};
  effect.apply = [](const std::vector<double>& v, Setup& setup) { setup.counter_Pa += v[0] * 101325; };
  effect.why_not = [](const Setup& declared) -> std::string {
    for (const Inflation& run : declared.inflations)
      if (run.vessel >= 0) return "";
    return "no run is in a vessel";
  };
  return effect;
}

}  // namespace ostium::data::pressure_diameter
