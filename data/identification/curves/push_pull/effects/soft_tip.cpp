/// The last part of the wire is softer than declared: it presses less in bends, until the stiff part follows.
#include "data/identification/curves/push_pull/push_pull.h"

namespace ostium::data::push_pull {

Effect soft_tip() {
  Effect effect;
  effect.head.id = "soft_tip";
  effect.head.what = "a tip that is softer than declared";
  effect.head.parameters = {{"length_mm", "mm", "length of the soft part", 30, 0.7, 3, 400, true},
                            {"share", "1", "its stiffness against that declared", 0.4, 0.6, 0.01, 0.97, true}};
  effect.apply = [](const std::vector<double>& v, Setup& setup) {
    setup.soft_m = v[0] * 1e-3, setup.soft_share = v[1];
  };
  return effect;
}

}  // namespace ostium::data::push_pull
