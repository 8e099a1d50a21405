/// The gantry gives under its weight or its encoders have another scale: the C-arm's angles are off by what goes with
/// the angle itself, in all views alike. As a share, d(angle) = share angle; as flex, d(angle) = flex sin(angle), the
/// moment of a weight about the pivot. Source and detector turn together about the isocentre.
#include <cmath>

#include "core/base/units.h"
#include "data/identification/effects/view_tools.h"

namespace ostium::data {

namespace gantry_flex_parts {

using units::degree;

constexpr double least_apart = 10 * degree;  // two views that would part it from an angle off in one

std::string why_not(const MeasurementSet& set, std::optional<int> instrument) {
  if (set.views.empty()) return no_views(set, instrument);
  const GantryAngles first = gantry_angles(set.views[0].camera.outwards());
  for (const MeasuredCArm& arm : set.views) {
    const GantryAngles other = gantry_angles(arm.camera.outwards());
    if (std::fabs(other.primary_rad - first.primary_rad) > least_apart ||
        std::fabs(other.secondary_rad - first.secondary_rad) > least_apart)
      return "";
  }
  return "all views have one angle";
}

void see(const ActiveEffect& effect, const MeasurementSet&, const Experiment&, MeasuredView& view) {
  const Eigen::Vector3d centre = isocentre_m(view.cameras);
  const auto& v = effect.values;
  const auto off = [](double angle, double share, double flex_deg) {
    return share * angle + flex_deg * degree * std::sin(angle);
  };
  for (Camera& camera : view.cameras) {
    const GantryAngles at = gantry_angles(camera.outwards());
    turn_about(camera, centre, gantry_turn(at, {off(at.primary_rad, v[0], v[2]), off(at.secondary_rad, v[1], v[3])}));
  }
}

std::vector<EffectForm> forms(const MeasurementSet&, std::optional<int>) {
  return {{"share", {{"primary_flex_deg", 0}, {"secondary_flex_deg", 0}}},
          {"flex", {{"primary_share", 0}, {"secondary_share", 0}}}};
}

}  // namespace gantry_flex_parts

Effect gantry_flex() {
  using namespace gantry_flex_parts;
  Effect effect;
  effect.id = "gantry_flex";
  effect.what = "a gantry that gives with its angle";
  effect.parameters = {{"primary_share", "1", "of the primary angle, beyond it", 0, 0.03, -0.5, 0.5, false},
                       {"secondary_share", "1", "of the secondary angle, beyond it", 0, 0.03, -0.5, 0.5, false},
                       {"primary_flex_deg", "deg", "primary angle beyond at 90 degrees", 0, 2, -30, 30, false},
                       {"secondary_flex_deg", "deg", "secondary angle beyond at 90 degrees", 0, 2, -30, 30, false}};
  effect.why_not = why_not, effect.see = see, effect.forms = forms;
  return effect;
}

}  // namespace ostium::data
