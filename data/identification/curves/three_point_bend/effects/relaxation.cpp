/// A share of the force dies away with time while the wire is held bent (Maxwell's element beside a spring): slow runs
/// are softer than fast ones, and the way back is lower.
#include "data/identification/curves/three_point_bend/three_point_bend.h"

namespace ostium::data::three_point_bend {

Effect relaxation() {
  Effect effect;
  effect.head.id = "relaxation";
  effect.head.what = "force that relaxes with time";
  effect.head.parameters = {{"share", "1", "share of the force that relaxes", 0.15, 0.1, 0, 0.8, false},
                            {"time_s", "s", "its time constant", 20, 1, 0.5, 2000, true}};
  effect.apply = [](const std::vector<double>& v, Setup& setup) { setup.relaxing = v[0], setup.relaxation_s = v[1]; };
  return effect;
}

}  // namespace ostium::data::three_point_bend
