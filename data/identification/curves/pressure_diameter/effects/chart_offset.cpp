/// The chart is off by the same diameter at every pressure, as if it were that of another skin thickness or fold.
#include "data/identification/curves/pressure_diameter/pressure_diameter.h"

namespace ostium::data::pressure_diameter {

Effect chart_offset() {
  Effect effect;
  effect.head.id = "chart_offset";
  effect.head.what = "a chart that is off by a diameter";
  effect.head.parameters = {{"mm", "mm", "by how much the balloon is wider", 0, 0.2, -1, 1, false}};
  effect.head.confused_with = "gauge_offset";
  effect.apply = [](const std::vector<double>& v, Setup& setup) { setup.chart_more_m += v[0] * 1e-3; };
  return effect;
}

}  // namespace ostium::data::pressure_diameter
