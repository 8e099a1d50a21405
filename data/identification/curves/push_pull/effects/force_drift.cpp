/// The load cell at the hand drifts in proportion to the time since the first run began.
#include "data/identification/curves/push_pull/push_pull.h"

namespace ostium::data::push_pull {

Effect force_drift() {
  Effect effect;
  effect.head.id = "force_drift";
  effect.head.what = "a load cell that drifts";
  effect.head.parameters = {{"mN_per_min", "mN/min", "its drift", 0, 5, -200, 200, false}};
  effect.apply = [](const std::vector<double>& v, Setup& setup) { setup.drift_N_per_s = v[0] * 1e-3 / 60; };
  effect.why_not = [](const Setup& declared) -> std::string {
    for (const Passage& run : declared.runs)
      if (run.time_s.size() > 0) return "";
    return "no run has times";
  };
  return effect;
}

}  // namespace ostium::data::push_pull
