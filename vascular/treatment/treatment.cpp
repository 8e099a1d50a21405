#include "vascular/treatment/treatment.h"

#include <algorithm>
#include <cmath>

#include "core/base/units.h"

namespace ostium::vascular {

namespace {

constexpr double pool_m3 = 1.5e-6;               // blood beside a hole
constexpr double fills_s = 0.4, empties_s = 15;  // filling and emptying of a pocket beside the lumen

void run_injuries(const FlowTree& tree, double dt, TreatmentState& s, PhysiologyState& physiology) {
  ContrastState& contrast = physiology.contrast;
  const std::size_t n = tree.cells.size();
  for (Injury& injury : s.injury.injuries) {
    if (injury.cell < 0) continue;
    const auto cell = static_cast<std::size_t>(injury.cell);
    const double r = physiology.radius_m[cell], V = units::pi * r * r * tree.cells[cell].length_m;
    double all = 0;
    for (int k = 0; k < layers; ++k) all += contrast.sheath_kg[k * n + cell];
    const double here = all / std::max(V, 1e-12), pocket = pocket_m3(injury);
    injury.outside_m3 = std::max(injury.outside_m3, pocket);
    const double inside = injury.outside_kg / injury.outside_m3;
    double kg = leak_m3_s(injury) * dt * here;
    // A pool beside the hole; the excess flows into the pericardium and is diluted.
    const double leaked = leak_m3_s(injury) * dt, over = std::max(0.0, injury.outside_m3 + leaked - pool_m3);
    injury.outside_kg *= 1 - over / (injury.outside_m3 + leaked);
    injury.outside_m3 += leaked - over;
    kg += here > inside ? (here - inside) * pocket * dt / fills_s : (here - inside) * pocket * dt / empties_s;
    kg = std::clamp(kg, -0.5 * injury.outside_kg, 0.5 * all);
    for (int k = 0; k < layers; ++k)
      contrast.sheath_kg[k * n + cell] -= all > 0 ? kg * contrast.sheath_kg[k * n + cell] / all : kg / layers;
    injury.outside_kg += kg;
    contrast.outside_kg += kg;
  }
}

void set_radii(const TreatmentModel& model, const FlowTree& tree, const TreatmentState& s,
               PhysiologyState& physiology) {
  const double wider = model.drugs.nitrate_widens * s.drugs.nitrate;
  for (std::size_t b = 0; b < tree.branches.size(); ++b)
    for (int c = tree.branches[b].first; c < tree.branches[b].last; ++c) {
      // Muscular wall that is neither stiffened by plaque nor held by a device.
      const PlaqueCell& cell = model.plaque.cells[c];
      const bool free = cell.diseased_m > 0.9 * cell.healthy_m && s.wall.radius_m[c] <= s.wall.rest_m[c];
      physiology.radius_m[c] = s.wall.radius_m[c] * (free ? (1 + wider) * (1 - s.spasm[b]) : 1);
    }
}

const BalloonModel* balloon_of(const TreatmentModel& model, const TreatmentInputs& in) {
  return in.balloon >= 0 ? &model.balloons[in.balloon] : nullptr;
}
const VesselPath* path_of(const TreatmentModel& model, const TreatmentInputs& in) {
  return in.branch >= 0 ? &model.paths[in.branch] : nullptr;
}
/// The stent that is, or was, crimped on the balloon in use; -1 if none.
int own_stent(const TreatmentModel& model, const TreatmentInputs& in) {
  return in.balloon >= 0 ? model.stent_on[in.balloon] : -1;
}

/// Whether a stent lies in the wall of the balloon's vessel.
bool is_beside(const TreatmentModel& model, const TreatmentInputs& in, const StentState& stent) {
  const VesselPath* path = path_of(model, in);
  return path && stent.where == StentState::deployed && stent.branch >= 0 &&
         same_vessel(model.paths[static_cast<std::size_t>(stent.branch)], *path, stent.middle_m);
}

void change_balloon(const TreatmentModel& model, const TreatmentInputs& in, TreatmentState& s) {
  if (s.balloon_in != in.balloon) {
    s.balloon_in = in.balloon;
    if (in.balloon >= 0) s.balloon = make_balloon_state(model.balloons[in.balloon]);
  }
  // A crimped stent moves with its balloon; set before the balloon's step.
  if (const int own = own_stent(model, in); own >= 0 && s.stents[own].where == StentState::on_balloon)
    s.stents[own].branch = in.branch, s.stents[own].middle_m = in.middle_m + s.balloon.slip_m;
}

/// Whether an unopened stent blocks the balloon's position.
bool is_blocked(const TreatmentModel& model, const TreatmentInputs& in, const TreatmentState& s) {
  const BalloonModel* balloon = balloon_of(model, in);
  if (!balloon || !path_of(model, in)) return false;
  const double end = in.middle_m + balloon->length_m / 2 + balloon->shoulder_m;
  for (std::size_t i = 0; i < s.stents.size(); ++i)
    if (is_beside(model, in, s.stents[i]) && narrowest_m(model.stents[i], s.stents[i], -1, end) < balloon->folded_m)
      return true;
  return false;
}

/// Releases the contents of a burst balloon into the vessel.
void spill(const VesselPath& path, double middle_m, double spilt_m3, double iodine_kg_m3, std::size_t cells,
           ContrastState& contrast) {
  const auto cell = static_cast<std::size_t>(path.cells[path.at(middle_m).index]);
  const double kg = spilt_m3 * iodine_kg_m3;
  for (int k = 0; k < layers; ++k) contrast.sheath_kg[k * cells + cell] += kg / layers;
  contrast.injected_kg += kg, contrast.injected_m3 += spilt_m3;
}

BalloonReport inflate(const TreatmentModel& model, const TreatmentInputs& in, double dt, TreatmentState& s,
                      const TreatedVessels& vessels, TreatmentScratch& x) {
  const BalloonModel& balloon = *balloon_of(model, in);
  const VesselPath* path = path_of(model, in);
  const int own = own_stent(model, in);
  const bool whole = !s.balloon.burst;
  // Stents in the wall, and the one on this balloon; others are not in the vessel.
  Sleeve sleeve;
  for (std::size_t i = 0; i < s.stents.size(); ++i)
    if (is_beside(model, in, s.stents[i]) ||
        (static_cast<int>(i) == own && s.stents[i].where == StentState::on_balloon))
      add_sleeve(model.stents[i], s.stents[i], balloon, s.balloon, in.middle_m, x.stent, sleeve);
  const BalloonReport report =
      step(balloon, model.plaque, {path, in.middle_m, in.gauge_Pa, sleeve}, dt, s.balloon, s.wall, x.balloon);
  if (report.touches || report.spilt_m3 > 0)
    judge_stretch(model.injury, model.plaque, s.wall, balloon.length_m, whole && s.balloon.burst,
                  vessels.physiology.heart.time_s, s.injury);
  if (report.spilt_m3 > 0 && path)
    spill(*path, in.middle_m, report.spilt_m3, balloon.iodine_kg_m3, vessels.tree.cells.size(),
          vessels.physiology.contrast);
  return report;
}

/// Steps stents in the wall and the one on the balloon.
void step_stents(const TreatmentModel& model, const TreatmentInputs& in, bool blocked, double dt, TreatmentState& s) {
  const BalloonModel* balloon = balloon_of(model, in);
  const int own = own_stent(model, in);
  for (std::size_t i = 0; i < s.stents.size(); ++i) {
    StentState& stent = s.stents[i];
    const bool mine = static_cast<int>(i) == own && balloon,
               within = balloon && !blocked && (mine || is_beside(model, in, stent));
    if (stent.where == StentState::lost || (stent.where == StentState::on_balloon && !mine)) continue;
    step(model.stents[i], model.plaque,
         {.path = stent.branch >= 0 ? &model.paths[static_cast<std::size_t>(stent.branch)] : nullptr,
          .balloon = within ? balloon : nullptr,
          .balloon_state = &s.balloon,
          .balloon_middle_m = in.middle_m,
          .drag_N = mine ? in.drag_N : 0,
          .edge_m = in.edge_m,
          .edge_N = is_beside(model, in, stent) ? in.edge_N : 0},
         dt, stent, s.wall);
  }
}

/// Sets what occupies the lumen besides blood: shafts and the balloon.
void fill_lumen(const TreatmentModel& model, const TreatmentInputs& in, bool blocked, const TreatmentState& s,
                const TreatedVessels& vessels) {
  std::vector<double>& occupied_m = vessels.occupied_m;
  if (in.shaft_m.empty())
    occupied_m.assign(vessels.tree.cells.size(), 0);
  else
    occupied_m.assign(in.shaft_m.begin(), in.shaft_m.end());
  const BalloonModel* balloon = balloon_of(model, in);
  const VesselPath* path = path_of(model, in);
  if (!balloon || !path || blocked) return;
  for (std::size_t k = 0; k < path->cells.size(); ++k) {
    double& occupied = occupied_m[path->cells[k]];
    occupied = std::max(occupied, radius_at(*balloon, s.balloon, in.middle_m, path->s_m[k]));
  }
}

}  // namespace

TreatmentState make_state(const TreatmentModel& model, const FlowTree& tree) {
  TreatmentState s;
  s.wall = make_plaque_state(model.plaque);
  s.balloon.radius_m.assign(balloon_spheres, 0);
  for (const StentModel& stent : model.stents) s.stents.push_back(make_stent_state(stent));
  s.spasm.assign(tree.branches.size(), 0);
  return s;
}

TreatmentReport step(const TreatmentModel& model, const TreatmentInputs& in, double dt, TreatmentState& s,
                     const TreatedVessels& vessels, TreatmentScratch& x) {
  TreatmentReport report;
  step(model.drugs, in.doses, dt, s.drugs);
  for (double& spasm : s.spasm) spasm *= std::exp(-dt * s.drugs.nitrate / model.drugs.spasm_yields_s);
  std::copy(s.wall.rest_m.begin(), s.wall.rest_m.end(), s.wall.radius_m.begin());
  change_balloon(model, in, s);
  report.blocked = is_blocked(model, in, s);
  const int injured = s.injury.count;
  if (in.balloon >= 0 && !report.blocked) report.balloon = inflate(model, in, dt, s, vessels, x);
  step_stents(model, in, report.blocked, dt, s);
  if (in.wire_tip_cell >= 0)
    judge_wire(model.injury, in.wire_tip_cell, s.wall.radius_m[in.wire_tip_cell], in.wire_tip_N, dt,
               vessels.physiology.heart.time_s, s.injury);
  report.tore = s.injury.count > injured;
  set_radii(model, vessels.tree, s, vessels.physiology);
  run_injuries(vessels.tree, dt, s, vessels.physiology);
  fill_lumen(model, in, report.blocked, s, vessels);
  return report;
}

}  // namespace ostium::vascular
