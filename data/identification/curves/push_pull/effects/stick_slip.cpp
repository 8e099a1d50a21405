/// Friction at rest is larger than in motion: a wire that is pushed slowly stands while the hand goes on and force
/// builds up by the stiffness of hand and wire, then slips to where friction in motion holds it; forces have saw-teeth.
/// Friction at rest is not the same at each place, so that no law foresees the tenth slip: when it slips is read from
/// the measured force, in runs that have such falls (`falls_of`); what builds up between them, and to what, is fitted.
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
  effect.why_not = [](const Setup& declared) -> std::string {
    for (const Passage& run : declared.runs)
      if (!run.slips.empty()) return "";
    return "no run has falls of force as a slip makes them";
  };
  return effect;
}

}  // namespace ostium::data::push_pull
