/// Friction at rest is larger than in motion: a wire that is pushed slowly stands while the hand goes on and force
/// builds up by the stiffness of hand and wire, then slips to where friction in motion holds it; forces have saw-teeth.
/// No law foresees the tenth slip, so that teeth are scored by a likelihood averaged over their phase (saw_teeth.h).
/// Up to which speed the wire sticks follows from the likelihoods of the runs.
#include <algorithm>

#include "data/identification/curves/push_pull/push_pull.h"

namespace ostium::data::push_pull {

Effect stick_slip() {
  Effect effect;
  effect.head.id = "stick_slip";
  effect.head.what = "a wire that sticks and slips";
  effect.head.parameters = {
      {"static_more", "1", "friction at rest against that in motion, less 1", 0.3, 0.7, 0.01, 5, true},
      {"N_per_mm", "N/mm", "stiffness of hand and wire", 0.02, 1, 1e-4, 10, true}};
  effect.apply = [](const std::vector<double>& v, Setup& setup) {
    setup.sticking = v[0], setup.hand_N_per_m = v[1] * 1e3;
  };
  effect.adapt = [](const Setup& declared, std::vector<EffectParameter>& parameters) {
    const Sticking likely = likely_sticking(declared);
    parameters[0].prior = std::clamp(likely.static_more, parameters[0].least, parameters[0].most);
    parameters[1].prior = std::clamp(likely.stiffness_N_per_m * 1e-3, parameters[1].least, parameters[1].most);
  };
  return effect;
}

}  // namespace ostium::data::push_pull
