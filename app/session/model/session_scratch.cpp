#include <memory>

#include "app/session/model/session.h"

namespace ostium::app {

SessionScratch::SessionScratch(const SessionModel& model, WallCopy copy) : now(model.rods), rods(model.rods) {
  inputs.rods.resize(model.tools.size());
  inputs.surfaces.resize(1);
  if (!model.has_patient()) return;
  if (copy == WallCopy::at_once) own_the_wall(model);
  coupling.emplace(*model.vessel);
  physiology_inputs.occupied_m.reserve(model.physiology.flow.tree.cells.size());
}

void SessionScratch::own_the_wall(const SessionModel& model) {
  const auto own = std::make_shared<core::Surface>(*now.surfaces[0]);
  now.surfaces = {own};
  wall.emplace(*model.vessel, *own, model.bed.has_value());
}

void SessionScratch::set_wall(const SessionModel& model, const std::vector<double>& wall_m,
                              const std::vector<Eigen::Vector3d>& wall_aside_P) {
  if (!wall && !is_opened(*model.vessel, wall_m) && !is_aside(wall_aside_P)) return;
  if (!wall) own_the_wall(model);
  wall->set(wall_m, wall_aside_P);
}

}  // namespace ostium::app
