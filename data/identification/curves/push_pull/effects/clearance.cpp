/// The bore is wider or narrower than declared: a wire presses by its stiffness as 1 / sqrt(clearance), and a tip goes
/// further into a bend before it touches (channel_beam.h). In one bore a stiffer wire looks much the same.
#include <algorithm>

#include "data/identification/curves/push_pull/push_pull.h"

namespace ostium::data::push_pull {

Effect clearance() {
  Effect effect;
  effect.head.id = "clearance";
  effect.head.what = "a bore other than declared";
  effect.head.parameters = {{"bore_more_mm", "mm", "by how much the bore is wider", 0, 0.1, -3, 3, false}};
  effect.apply = [](const std::vector<double>& v, Setup& setup) { setup.bore_more_m = v[0] * 1e-3 / 2; };
  effect.adapt = [](const Setup& declared, std::vector<EffectParameter>& parameters) {
    double least = 1;
    for (const Passage& run : declared.runs) least = std::min(least, run.bore_radius_m - declared.radius_m);
    parameters[0].spread = 0.5 * least * 2e3, parameters[0].least = -0.9 * least * 2e3;
  };
  return effect;
}

}  // namespace ostium::data::push_pull
