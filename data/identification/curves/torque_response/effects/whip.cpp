/// A wire that is curved at rest would rather lie in a bend with its own curvature in the bend's plane: energy per
/// length -EI kappa_0 / R cos(angle between), so a torque that grows and falls once a turn, and the distal end lags and
/// jumps. Where it is strong the wire has several angles at rest; it stays at one until that vanishes, then snaps (as
/// curved tubes in one another do: Dupont, Lock, Itkowitz, Butler 2010, IEEE Trans Robot 26:209).
#include "data/identification/curves/torque_response/torque_response.h"

namespace ostium::data::torque_response {

namespace {

std::string no_bends(const Setup& declared) {
  for (const Turning& run : declared.runs)
    if (!run.bends.empty()) return "";
  return "no path has a bend";
}

}  // namespace

Effect whip() {
  Effect effect;
  effect.head.id = "whip";
  effect.head.what = "a wire that is curved at rest and whips in bends";
  effect.head.parameters = {
      {"to_mark_per_mm", "1/mm", "its curvature at rest, in the plane of bends at 0 degrees", 0, 1e-3, -0.02, 0.02,
       false},
      {"across_per_mm", "1/mm", "its curvature at rest a quarter turn from there", 0, 1e-3, -0.02, 0.02, false}};
  effect.apply = [](const std::vector<double>& v, Setup& setup) {
    setup.rest_per_m[0] = v[0] * 1e3, setup.rest_per_m[1] = v[1] * 1e3;
  };
  effect.why_not = no_bends;
  return effect;
}

}  // namespace ostium::data::torque_response
