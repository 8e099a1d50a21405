/// Runout of the clamp: the base tangent is off axis and turns with the roll, as in a collet that does not run true.
/// The frame at the base is tilted by `tilt_1_deg` about d1 and `tilt_2_deg` about d2 of the rolled frame. Nested:
/// applies to the chosen instrument's drive, or the outermost one's if none is chosen.
#include <Eigen/Geometry>

#include "core/base/units.h"
#include "data/identification/effects/tools.h"

namespace ostium::data {

namespace clamp_runout_parts {

std::string why_not(const MeasurementSet&, std::optional<int>) { return ""; }

void apply(const ActiveEffect& effect, const MeasurementSet&, const Experiment&, ExperimentSetup& setup) {
  const double degree = units::pi / 180;
  // Uses the roll that arrives after all other effects, in the instrument's own directors.
  const double roll = setup.nest.parts[effect.instrument.value_or(0)].roll_rad - setup.material_turn_rad;
  const Eigen::Vector3d tilt(effect.values[0] * degree, effect.values[1] * degree, 0);
  const double angle = tilt.norm();
  if (angle == 0) return;
  const Eigen::Vector4d& b = setup.base.q_W;
  const Eigen::Quaterniond q =
      Eigen::Quaterniond(b[0], b[1], b[2], b[3]) * Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitZ()) *
      Eigen::AngleAxisd(angle, tilt / angle) * Eigen::AngleAxisd(-roll, Eigen::Vector3d::UnitZ());
  setup.base.q_W = {q.w(), q.x(), q.y(), q.z()};
}

}  // namespace clamp_runout_parts

Effect clamp_runout() {
  using namespace clamp_runout_parts;
  Effect effect;
  effect.id = "clamp_runout";
  effect.what = "a base that does not run true";
  effect.parameters = {{"tilt_1_deg", "deg", "tilt of the base about d1", 0, 2, -30, 30, false},
                       {"tilt_2_deg", "deg", "tilt of the base about d2", 0, 2, -30, 30, false}};
  effect.why_not = why_not, effect.apply = apply;
  effect.of_one_instrument = true;
  effect.confused_with = "registration";
  return effect;
}

}  // namespace ostium::data
