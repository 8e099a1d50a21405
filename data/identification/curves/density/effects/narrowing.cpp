/// The lumen is narrower, or wider, than declared on a stretch: less of it is in the picture there, and the way is
/// shorter.
#include "data/identification/curves/density/density.h"

namespace ostium::data::density {

Effect narrowing() {
  Effect effect;
  effect.head.id = "narrowing";
  effect.head.what = "a lumen that is other than declared on a stretch";
  effect.head.parameters = {{"at_mm", "mm", "its middle", 0, 0, 0, 0, false},
                            {"length_mm", "mm", "its length", 15, 0.7, 3, 60, true},
                            {"factor", "1", "diameter against what is declared", 0.85, 0.3, 0.2, 2, true}};
  effect.adapt = along_the_sites;
  effect.apply = [](const std::vector<double>& v, Setup& setup) {
    setup.narrow = {(v[0] - v[1] / 2) * 1e-3, (v[0] + v[1] / 2) * 1e-3, v[2]};
  };
  return effect;
}

}  // namespace ostium::data::density
