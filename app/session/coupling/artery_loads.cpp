#include "app/session/coupling/artery_loads.h"

#include "app/session/coupling/looks.h"
#include "app/session/vessel/opened_wall.h"

namespace ostium::app {

using Eigen::Vector3d;

namespace {

constexpr double outside_m = 1e-3;  // beyond its radius, at which a touched wall is still the artery's

void add_balloon(const CouplingModel& model, const vascular::BalloonState& state, double phase, const CoupledBalloon& s,
                 CouplingScratch& x) {
  const vascular::BalloonModel& balloon = model.treatment.balloons[static_cast<std::size_t>(s.balloon)];
  const vascular::VesselPath& path = model.treatment.paths[static_cast<std::size_t>(s.branch)];
  const auto centre = [&](std::size_t k) {
    return model.vessel.coronaries->map.centre(static_cast<std::size_t>(path.cells[k]), {.phase = phase});
  };
  const std::vector<int>& upstream = model.vessel.arteries.upstream;
  for (std::size_t k = 2; k < path.cells.size(); ++k) {
    if (upstream[path.cells[k]] != path.cells[k - 1] || upstream[path.cells[k - 1]] != path.cells[k - 2])
      continue;  // it turns into a side branch
    const double radius_m = radius_at(balloon, state, path.s_m[k - 1]);
    if (radius_m < balloon.refolded_m) continue;
    const vascular::PressurisedTube tube = vascular::pressurised_tube(radius_m, state.pressure_Pa, skin_N_m(balloon));
    if (tube.EI_N_m2 > 0)
      x.tubes.push_back({path.cells[k], tube, vascular::curvature_of(centre(k - 2), centre(k - 1), centre(k))});
  }
}

}  // namespace

void find_artery_loads(const CouplingModel& model, const core::StepReport& report,
                       const vascular::TreatmentState& treatment, const vascular::TreatmentReport& treated,
                       double phase, const CouplingState& s, CouplingScratch& x) {
  const std::vector<vascular::FlowCell>& cells = model.physiology.flow.tree.cells;
  x.load_P_N.assign(cells.size(), Vector3d::Zero());
  int near = -1;
  for (const core::Touch& touch : report.touches) {
    const vascular::CellLocator::Found found = x.locator.nearest(touch.p_W, near_heart_m, near);
    near = found.cell;
    if (found.cell < 0) continue;
    const auto cell = static_cast<std::size_t>(found.cell);
    if (found.distance_m < cells[cell].healthy_m + outside_m) x.load_P_N[cell] -= touch.normal_W_N + touch.friction_W_N;
  }
  x.tubes.clear();
  for (int k = 0; k < vascular::most_balloons; ++k)
    if (treated.balloons[k].touches && s.balloons[k].balloon >= 0 && s.balloons[k].branch >= 0)
      add_balloon(model, treatment.balloons[k], phase, s.balloons[k], x);
}

void give_way(const vascular::ArteryBedModel& model, double dt_s, CouplingScratch& x, vascular::ArteryBedState& bed,
              std::vector<Vector3d>& wall_aside_P) {
  step(model, {x.load_P_N, x.tubes}, dt_s, bed, x.bed);
  follow_aside(bed.aside_P, wall_aside_P);
}

}  // namespace ostium::app
