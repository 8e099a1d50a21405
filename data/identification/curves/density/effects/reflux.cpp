/// A share of what is injected runs back into the aorta, even while the artery could take it.
#include "data/identification/curves/density/density.h"

namespace ostium::data::density {

Effect reflux() {
  Effect effect;
  effect.head.id = "reflux";
  effect.head.what = "contrast that runs back into the aorta";
  effect.head.parameters = {{"share", "1", "share of the injection that runs back", 0.2, 0.2, 0, 0.9, false}};
  effect.head.confused_with = "side_branch";
  effect.apply = [](const std::vector<double>& v, Setup& setup) { setup.runs_back = v[0]; };
  return effect;
}

}  // namespace ostium::data::density
