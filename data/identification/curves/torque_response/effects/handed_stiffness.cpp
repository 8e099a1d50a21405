/// A shaft that is coiled or braided one way is stiffer when a turn winds it up than when it unwinds it: GJ differs by
/// the sense of the torque.
#include "data/identification/curves/torque_response/torque_response.h"

namespace ostium::data::torque_response {

namespace {

std::string never_twisted(const Setup& declared) {
  for (const Turning& run : declared.runs)
    if (!run.contacts.empty()) return "";
  return "the wire is never twisted";
}

}  // namespace

Effect handed_stiffness() {
  Effect effect;
  effect.head.id = "handed_stiffness";
  effect.head.what = "torsional stiffness that differs by the sense of the torque";
  effect.head.parameters = {
      {"ratio", "1", "stiffness under positive torque against that under negative", 1, 0.4, 0.05, 20, true}};
  effect.apply = [](const std::vector<double>& v, Setup& setup) { setup.handed = v[0]; };
  effect.why_not = never_twisted;
  return effect;
}

}  // namespace ostium::data::torque_response
