/// The rollers are not as far apart as was written down, by the same length in every run: short spans show it most.
#include "data/identification/curves/three_point_bend/three_point_bend.h"

namespace ostium::data::three_point_bend {

Effect span_error() {
  Effect effect;
  effect.head.id = "span_error";
  effect.head.what = "a span that is off";
  effect.head.parameters = {{"more_mm", "mm", "by how much the span is longer", 0, 1, -5, 5, false}};
  effect.head.confused_with = "machine_compliance";
  effect.apply = [](const std::vector<double>& v, Setup& setup) { setup.span_more_m = v[0] * 1e-3; };
  return effect;
}

}  // namespace ostium::data::three_point_bend
