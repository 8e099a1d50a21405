#include <algorithm>
#include <cmath>

#include "app/session/coupling/looks.h"
#include "app/session/coupling/tool_geometry.h"
#include "core/rod/introducer.h"

namespace ostium::app {

using Eigen::Vector3d;

namespace {

constexpr double edge_s = 0.02;  // in which a stent's push on the guide comes and goes

/// The first catheter in the body; the outermost.
int guide_of(const CouplingModel& model, const core::State& rods) {
  for (std::size_t t = 0; t < model.tools.size(); ++t)
    if (is_catheter(model.tools[t].instrument) && in_body(model.rods.rods[t], rods.rods[t])) return static_cast<int>(t);
  return -1;
}

}  // namespace

void look_at_guide(const CouplingModel& model, const core::State& rods, const core::StepReport& report,
                   const vascular::LumenMoment& moment, const Vector3d& root_shift, CouplingScratch& x,
                   CouplingState& s) {
  const int g = guide_of(model, rods);
  s.guide = g;
  s.tip = {}, s.covered = s.filled_m = 0, s.in_ventricle = s.thick_wire = false;
  if (g < 0) return;
  const core::Rod& rod = model.rods.rods[static_cast<std::size_t>(g)];
  const core::RodState& own = rods.rods[static_cast<std::size_t>(g)];
  const Vector3d p = own.position[rod.elements], direction = direction_at_tip(rod, own);
  const vascular::Patient& patient = *model.vessel.patient;
  s.tip = tip_place(x.locator, model.physiology.flow.tree, model.physiology.contrast, patient,
                    model.vessel.coronaries->map, moment, p, direction);
  s.in_ventricle = beyond_valve_m(patient.anatomy.landmarks, p - root_shift) > 0;
  for (const core::Touch& touch : report.touches)
    if (touch.rod == g && touch.node == rod.elements) {
      const double faces = -direction.dot(touch.normal_W_N.normalized());
      s.covered = std::max(s.covered, std::clamp(2 * (faces - 0.5), 0.0, 0.95));
    }
  for (std::size_t t = 0; t < model.tools.size(); ++t) {
    if (static_cast<int>(t) == g || !in_body(model.rods.rods[t], rods.rods[t])) continue;
    const core::Rod& inner = model.rods.rods[t];
    const double radius = inner.radius.at(0)[std::max(rods.rods[t].first, inner.elements - 100)];
    s.filled_m = std::max(s.filled_m, radius);
    if (model.tools[t].instrument.kind == data::InstrumentKind::wire && radius > thick_wire_m) s.thick_wire = true;
  }
}

void look_at_edge(const CouplingModel& model, const core::State& rods, const vascular::TreatmentState& treatment,
                  CouplingScratch& x, CouplingState& s) {
  s.edge_m = -1e9, s.edge_N = 0;
  double wanted = 0;
  if (s.guide >= 0 && s.tip.where == vascular::TipPlace::coronary) {
    const auto g = static_cast<std::size_t>(s.guide);
    const core::Rod& rod = model.rods.rods[g];
    const vascular::CellLocator::Found f = x.locator.nearest(rods.rods[g].position[rod.elements], near_heart_m);
    for (std::size_t i = 0; i < treatment.stents.size() && f.cell >= 0; ++i) {
      const vascular::StentState& stent = treatment.stents[i];
      if (stent.where != vascular::StentState::deployed || stent.branch < 0) continue;
      const vascular::VesselPath& path = model.treatment.paths[static_cast<std::size_t>(stent.branch)];
      const auto at = std::find(path.cells.begin(), path.cells.end(), f.cell);
      if (at == path.cells.end()) continue;
      const double tip_m = path.s_m[static_cast<std::size_t>(at - path.cells.begin())] + f.along_m;
      const auto [from, to] = span_of(stent);
      if (tip_m <= from || tip_m >= to) continue;
      const double outer = model.tools[g].instrument.outer_diameter_m / 2;
      if (outer + f.distance_m < stent.radius_m.front()) continue;  // it slides in
      s.edge_m = tip_m, s.edge_N = std::min(edge_N_m * (tip_m - from), most_caught_N);
      wanted = s.edge_N;
    }
  }
  s.edge_push_N += (wanted - s.edge_push_N) * look_every * model.rods.step_s / edge_s;
  if (s.edge_push_N < 1e-6) s.edge_push_N = 0;
}

}  // namespace ostium::app
