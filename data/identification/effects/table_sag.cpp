/// The table with everything on it hangs lower than declared, along gravity: by sag_mm at the frame's origin, and by
/// slope_mm_per_m more for each metre towards the patient's head (the frame's z), as a cantilever bends. The views,
/// which do not stand on the table, see it lower. A frame that is off along gravity looks the same.
#include <Eigen/Geometry>
#include <cmath>

#include "core/base/units.h"
#include "data/identification/effects/view_tools.h"

namespace ostium::data {

namespace table_sag_parts {

using Eigen::Vector3d;
using units::mm;

std::string why_not(const MeasurementSet& set, std::optional<int> instrument) {
  if (set.gravity_m_s2.isZero()) return "there is no gravity";
  return no_views(set, instrument);
}

void see(const ActiveEffect& effect, const MeasurementSet& set, const Experiment&, MeasuredView& view) {
  const Vector3d down = set.gravity_m_s2.normalized(), across = Vector3d::UnitZ().cross(down);
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  if (effect.values[1] != 0 && across.norm() > 1e-6)
    R = Eigen::AngleAxisd(std::atan(effect.values[1] * 1e-3), across.normalized()).toRotationMatrix();
  view.A = R * view.A;
  view.b_m = R * view.b_m + effect.values[0] * mm * down;
}

std::vector<EffectForm> forms(const MeasurementSet&, std::optional<int>) {
  return {{"level", {{"slope_mm_per_m", 0}}}, {"bent", {}}};
}

}  // namespace table_sag_parts

Effect table_sag() {
  using namespace table_sag_parts;
  Effect effect;
  effect.id = "table_sag";
  effect.what = "a table that sags";
  effect.parameters = {{"sag_mm", "mm", "how much lower along gravity", 0, 3, -100, 100, false},
                       {"slope_mm_per_m", "mm/m", "how much lower for each metre along z", 0, 20, -500, 500, false}};
  effect.why_not = why_not, effect.see = see, effect.forms = forms;
  effect.confused_with = "registration";
  return effect;
}

}  // namespace ostium::data
