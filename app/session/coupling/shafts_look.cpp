#include <algorithm>

#include "app/session/coupling/looks.h"
#include "app/session/coupling/tool_geometry.h"
#include "core/rod/introducer.h"

namespace ostium::app {

using Eigen::Vector3d;

namespace {

constexpr double irritates_m = 10e-3;  // beyond the valve at which a wire surely meets the ventricle's wall
constexpr double in_vessel = 1.6;      // radii from a centreline within which a point counts as inside

}  // namespace

void look_at_shafts(const CouplingModel& model, const core::State& rods, CouplingScratch& x, CouplingState& s) {
  std::fill(s.shaft_m.begin(), s.shaft_m.end(), 0);
  const vascular::FlowTree& tree = model.physiology.flow.tree;
  Vector3d low = x.locator.centre(0), high = low;
  for (int c = 1; c < static_cast<int>(tree.cells.size()); ++c)
    low = low.cwiseMin(x.locator.centre(c)), high = high.cwiseMax(x.locator.centre(c));
  low.array() -= near_heart_m, high.array() += near_heart_m;
  for (std::size_t t = 0; t < model.tools.size(); ++t) {
    const core::Rod& rod = model.rods.rods[t];
    const core::RodState& own = rods.rods[t];
    if (!in_body(rod, own)) continue;
    x.points.clear();
    for (int i = rod.elements; i > own.first; --i) {
      const Vector3d p = own.position[i];
      if ((p.array() < low.array()).any() || (p.array() > high.array()).any()) break;
      x.points.push_back(p);
    }
    occupy(x.locator, tree, x.points, rod.radius.at(0)[std::max(own.first, rod.elements - 40)], s.shaft_m);
  }
}

double tip_force_N(const CouplingModel& model, const core::StepReport& report, int tool) {
  constexpr double tip_m = 3e-3;
  const core::Rod& rod = model.rods.rods[static_cast<std::size_t>(tool)];
  Vector3d force_W_N = Vector3d::Zero();
  for (const core::Touch& touch : report.touches)
    if (touch.rod == tool && rod.node_from_tip_m[static_cast<std::size_t>(touch.node)] <= tip_m)
      force_W_N += touch.normal_W_N + touch.friction_W_N;
  return force_W_N.norm();
}

int cell_at_tip(const CouplingModel& model, const core::State& rods, int tool, const CouplingScratch& x) {
  const core::Rod& rod = model.rods.rods[static_cast<std::size_t>(tool)];
  const core::RodState& own = rods.rods[static_cast<std::size_t>(tool)];
  if (!in_body(rod, own)) return -1;
  const vascular::CellLocator::Found f = x.locator.nearest(own.position[rod.elements], near_heart_m);
  const vascular::FlowTree& tree = model.physiology.flow.tree;
  return f.cell >= 0 && f.distance_m < in_vessel * tree.cells[static_cast<std::size_t>(f.cell)].healthy_m ? f.cell : -1;
}

void look_at_wires(const CouplingModel& model, const core::State& rods, const core::StepReport& report,
                   const Vector3d& root_shift, CouplingScratch& x, CouplingState& s) {
  s.irritation = 0, s.wire_cell = -1;
  double most_N = 0;
  for (std::size_t t = 0; t < model.tools.size(); ++t) {
    const core::Rod& rod = model.rods.rods[t];
    const core::RodState& own = rods.rods[t];
    if (!in_body(rod, own)) continue;
    const int tool = static_cast<int>(t), cell = cell_at_tip(model, rods, tool, x);
    const Vector3d p = own.position[rod.elements];
    const vascular::Landmarks& marks = model.vessel.patient->anatomy.landmarks;
    if (model.vessel.ventricle.spheres.empty() && cell < 0 && (p - root_shift - marks.p_annulus).norm() < 0.06)
      s.irritation = std::max(s.irritation, std::clamp(beyond_valve_m(marks, p - root_shift) / irritates_m, 0.0, 1.0));
    if (!is_thin_wire(model.tools[t].instrument) || cell < 0) continue;
    // Of several wires, the one that presses hardest.
    const double now_N = tip_force_N(model, report, tool);
    if (s.wire_cell < 0 || now_N >= most_N) s.wire_cell = cell, most_N = now_N;
  }
}

}  // namespace ostium::app
