/// When the pressure falls, a share of the stent's diameter comes back, in proportion to how far it fell (measured: 1.5
/// to 16 %, Barragan 2000, Catheter Cardiovasc Interv 50:112).
#include "data/identification/curves/pressure_diameter/pressure_diameter.h"

namespace ostium::data::pressure_diameter {

Effect recoil() {
  Effect effect;
  effect.head.id = "recoil";
  effect.head.what = "a stent that springs back";
  effect.head.parameters = {{"share", "1", "of its largest diameter", 0.05, 0.05, 0, 0.5, false}};
  effect.apply = [](const std::vector<double>& v, Setup& setup) { setup.recoil += v[0]; };
  effect.why_not = [](const Setup& declared) -> std::string {
    for (const Inflation& run : declared.inflations)
      if (run.stented) return "";
    return "no run has a stent";
  };
  return effect;
}

}  // namespace ostium::data::pressure_diameter
