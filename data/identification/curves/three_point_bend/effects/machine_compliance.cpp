/// Frame, load cell and grips give way by what they press with: the wire is bent less than the machine moved. Stiff
/// short spans show it, soft long ones do not.
#include "data/identification/curves/three_point_bend/three_point_bend.h"

namespace ostium::data::three_point_bend {

Effect machine_compliance() {
  Effect effect;
  effect.head.id = "machine_compliance";
  effect.head.what = "a machine that gives way";
  effect.head.parameters = {{"mm_per_N", "mm/N", "how far the machine gives way", 0.2, 1.5, 1e-3, 20, true}};
  effect.head.confused_with = "span_error";
  effect.apply = [](const std::vector<double>& v, Setup& setup) { setup.machine_m_per_N += v[0] * 1e-3; };
  return effect;
}

}  // namespace ostium::data::three_point_bend
