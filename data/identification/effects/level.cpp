/// A rig that is not level: gravity is not along where the file has it. It is turned by the two angles about two axes
/// across it, the first of them as near to x as there is. Known loads at the tip are as declared.
#include <Eigen/Geometry>
#include <cmath>

#include "core/base/units.h"
#include "data/identification/effects/tools.h"

namespace ostium::data {

namespace level_parts {

std::string why_not(const MeasurementSet& set, std::optional<int>) {
  if (set.gravity_m_s2.isZero()) return "there is no gravity";
  for (const MeasuredInstrument& i : set.instruments)
    for (const core::Section& s : i.sections)
      if (s.kg_per_m > 0) return "";
  return "nothing weighs anything";
}

void apply(const ActiveEffect& effect, const MeasurementSet& set, const Experiment&, ExperimentSetup& setup) {
  const Eigen::Vector3d down = set.gravity_m_s2.normalized();
  const Eigen::Vector3d near_x = std::fabs(down.x()) < 0.9 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
  const Eigen::Vector3d first = (near_x - near_x.dot(down) * down).normalized(), second = down.cross(first);
  const Eigen::Vector3d turn = (effect.values[0] * first + effect.values[1] * second) * units::degree;
  if (turn.norm() > 0) setup.gravity_m_s2 = Eigen::AngleAxisd(turn.norm(), turn.normalized()) * setup.gravity_m_s2;
}

}  // namespace level_parts

Effect level() {
  using namespace level_parts;
  Effect effect;
  effect.id = "level";
  effect.what = "a rig that is not level";
  effect.parameters = {
      {"tilt_1_deg", "deg", "turn of gravity about the axis across it that is next to x", 0, 3, -45, 45, false},
      {"tilt_2_deg", "deg", "turn of gravity about the other axis across it", 0, 3, -45, 45, false}};
  effect.why_not = why_not, effect.apply = apply;
  return effect;
}

}  // namespace ostium::data
