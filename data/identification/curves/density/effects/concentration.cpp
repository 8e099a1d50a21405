/// The contrast has another iodine content than was declared (or the detector another gain).
#include "data/identification/curves/density/density.h"

namespace ostium::data::density {

Effect concentration() {
  Effect effect;
  effect.head.id = "concentration";
  effect.head.what = "iodine of another concentration";
  effect.head.parameters = {{"factor", "1", "iodine against what is declared", 1, 0.3, 0.2, 5, true}};
  effect.head.confused_with = "veiling_glare";
  effect.apply = [](const std::vector<double>& v, Setup& setup) { setup.iodine = v[0]; };
  return effect;
}

}  // namespace ostium::data::density
