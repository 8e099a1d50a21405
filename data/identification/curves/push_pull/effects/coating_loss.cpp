/// A slippery coating wears off: friction grows in proportion to the distance that the wire has run, in and out, since
/// the first run.
#include "data/identification/curves/push_pull/push_pull.h"

namespace ostium::data::push_pull {

Effect coating_loss() {
  Effect effect;
  effect.head.id = "coating_loss";
  effect.head.what = "a coating that wears off";
  effect.head.parameters = {
      {"per_m", "1/m", "growth of friction by a metre run, against that at first", 0, 0.2, -0.05, 10, false}};
  effect.apply = [](const std::vector<double>& v, Setup& setup) { setup.worn_per_m = v[0]; };
  return effect;
}

}  // namespace ostium::data::push_pull
