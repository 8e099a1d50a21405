/// The wire slides over the rollers with friction: the reaction stands under atan(friction) to the wire, against its
/// motion, so that pressing takes more force than letting back (three_point_bend.h).
#include "data/identification/curves/three_point_bend/three_point_bend.h"

namespace ostium::data::three_point_bend {

Effect support_friction() {
  Effect effect;
  effect.head.id = "support_friction";
  effect.head.what = "friction at the rollers";
  effect.head.parameters = {{"friction", "1", "coefficient of friction at the rollers", 0.15, 0.1, 0, 1, false}};
  effect.apply = [](const std::vector<double>& v, Setup& setup) { setup.friction = v[0]; };
  return effect;
}

}  // namespace ostium::data::three_point_bend
