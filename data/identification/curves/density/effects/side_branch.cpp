/// A share of the flow leaves at a place, with its iodine: behind it the rest is slower.
#include "data/identification/curves/density/density.h"

namespace ostium::data::density {

Effect side_branch() {
  Effect effect;
  effect.head.id = "side_branch";
  effect.head.what = "flow that leaves by a branch";
  effect.head.parameters = {{"at_mm", "mm", "where it leaves", 0, 0, 0, 0, false},
                            {"share", "1", "of the flow before it", 0.25, 0.2, 0, 0.95, false}};
  effect.head.confused_with = "reflux";
  effect.adapt = along_the_sites;
  effect.apply = [](const std::vector<double>& v, Setup& setup) { setup.branch = {v[0] * 1e-3, v[1]}; };
  return effect;
}

}  // namespace ostium::data::density
