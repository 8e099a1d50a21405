/// The load cell at the hand was not zeroed: the same force is added to every sample of every run.
#include "data/identification/curves/push_pull/push_pull.h"

namespace ostium::data::push_pull {

Effect zero_offset() {
  Effect effect;
  effect.head.id = "zero_offset";
  effect.head.what = "a load cell that was not zeroed";
  effect.head.parameters = {{"force_N", "N", "what it shows without a load", 0, 0.05, -5, 5, false}};
  effect.apply = [](const std::vector<double>& v, Setup& setup) { setup.zero_N = v[0]; };
  return effect;
}

}  // namespace ostium::data::push_pull
