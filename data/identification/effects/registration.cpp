/// Rigid registration error although registration is declared given: the measuring frame is turned about the first
/// base, and shifted.
#include <Eigen/Geometry>

#include "core/base/units.h"
#include "data/identification/effects/tools.h"

namespace ostium::data {

namespace registration_parts {

std::string why_not(const MeasurementSet& set, std::optional<int>) {
  if (set.imaging.registration_free) return "the measuring frame is fitted anyway";
  for (const Experiment& e : set.experiments)
    if (e.kind != Experiment::Kind::radius) return "";
  return "radii do not depend on the measuring frame";
}

void see(const ActiveEffect& effect, const MeasurementSet& set, const Experiment&, MeasuredView& view) {
  const auto& v = effect.values;
  const Eigen::Vector3d turn = Eigen::Vector3d(v[0], v[1], v[2]) * units::pi / 180;
  const Eigen::Vector3d shift = Eigen::Vector3d(v[3], v[4], v[5]) * 1e-3, about = set.experiments[0].base.p_W;
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  if (turn.norm() > 0) R = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  view.b_m = R * (view.b_m - about) + about + shift;
  view.A = R * view.A;
}

std::vector<EffectForm> forms(const MeasurementSet&, std::optional<int>) {
  return {{"turn and shift", {}},
          {"shift", {{"rx_deg", 0}, {"ry_deg", 0}, {"rz_deg", 0}}},
          {"turn", {{"x_mm", 0}, {"y_mm", 0}, {"z_mm", 0}}}};
}

}  // namespace registration_parts

Effect registration() {
  using namespace registration_parts;
  Effect effect;
  effect.id = "registration";
  effect.what = "a measuring frame that is off";
  for (const char* axis : {"x", "y", "z"})
    effect.parameters.push_back({std::string("r") + axis + "_deg", "deg",
                                 std::string("turn of the measuring frame about ") + axis, 0, 2, -45, 45, false});
  for (const char* axis : {"x", "y", "z"})
    effect.parameters.push_back({std::string(axis) + "_mm", "mm",
                                 std::string("shift of the measuring frame along ") + axis, 0, 3, -200, 200, false});
  effect.why_not = why_not, effect.see = see, effect.forms = forms;
  return effect;
}

}  // namespace ostium::data
