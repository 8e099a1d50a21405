/// Contrast opens the small vessels: the flow rises, q (1 + gain (1 - exp(-t / time))) since the injection began. A
/// flow 15 % larger was measured (Molloi 1996, Circulation 93:1919).
#include "data/identification/curves/density/density.h"

namespace ostium::data::density {

Effect contrast_hyperaemia() {
  Effect effect;
  effect.head.id = "contrast_hyperaemia";
  effect.head.what = "flow that rises with contrast";
  effect.head.parameters = {{"gain", "1", "share by which flow rises in the end", 0.15, 0.15, -0.5, 2, false},
                            {"time_s", "s", "its time constant", 2, 0.7, 0.2, 20, true}};
  effect.apply = [](const std::vector<double>& v, Setup& setup) { setup.rise = v[0], setup.rise_s = v[1]; };
  return effect;
}

}  // namespace ostium::data::density
