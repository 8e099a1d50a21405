/// One end of the balloon is wider than the other: the diameter changes along it in proportion to the way.
#include "data/identification/curves/pressure_diameter/pressure_diameter.h"

namespace ostium::data::pressure_diameter {

Effect taper() {
  Effect effect;
  effect.head.id = "taper";
  effect.head.what = "a balloon that tapers";
  effect.head.parameters = {{"mm_per_mm", "1", "diameter per length", 0, 0.02, -0.3, 0.3, false}};
  effect.apply = [](const std::vector<double>& v, Setup& setup) { setup.taper += v[0]; };
  effect.why_not = [](const Setup& declared) -> std::string {
    return declared.place_m.size() > 1 ? "" : "diameters are measured at one place";
  };
  return effect;
}

}  // namespace ostium::data::pressure_diameter
