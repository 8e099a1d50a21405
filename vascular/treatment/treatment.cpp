#include "vascular/treatment/treatment.h"

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "core/base/units.h"
#include "vascular/treatment/devices.h"
#include "vascular/treatment/plaque_shift.h"

namespace ostium::vascular {

namespace {

constexpr double pool_m3 = 1.5e-6;               // blood beside a hole
constexpr double muscle_opens_s = 20;            // under the full effect of a drug [estimate: onset 30 to 60 s]
constexpr double tight_m = 20e-6;                // a balloon with less play lies on the wall
constexpr double least_shift_m = 1e-6;           // of a carina
constexpr double closed_m = 1e-6;                // radius of a branch that is shut
constexpr double flap_m = 5e-3;                  // half of a flap's length [estimate]
constexpr double fills_from = 0.85;              // of an artery's radius, from which a guide fills it [estimate]
constexpr double fills_s = 0.4, empties_s = 15;  // filling and emptying of a pocket beside the lumen

void run_injuries(const TreatmentModel& model, const FlowTree& tree, double dt, TreatmentState& s,
                  PhysiologyState& physiology) {
  const double outside_Pa = physiology.heart.circulation.pericardium_Pa, act = act_s(model.drugs, s.drugs);
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
    age(act, dt, injury);
    injury.leak_m3_s = leak_m3_s(injury, physiology.flow.pressure_Pa[cell] - outside_Pa);
    double kg = injury.leak_m3_s * dt * here;
    // A pool beside the hole; the excess flows into the pericardium and is diluted.
    const double leaked = injury.leak_m3_s * dt, over = std::max(0.0, injury.outside_m3 + leaked - pool_m3);
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

/// Whether a covered stent's membrane lies over a cell.
bool is_under_membrane(const TreatmentModel& model, const TreatmentState& s, int cell) {
  for (std::size_t i = 0; i < s.stents.size(); ++i) {
    const StentState& stent = s.stents[i];
    if (!model.stents[i].covered || stent.where != StentState::deployed || stent.branch < 0) continue;
    const VesselPath& path = model.paths[static_cast<std::size_t>(stent.branch)];
    const auto at = std::find(path.cells.begin(), path.cells.end(), cell);
    if (at == path.cells.end()) continue;
    const double along = path.s_m[static_cast<std::size_t>(at - path.cells.begin())];
    const auto [from, to] = span_of(stent);
    if (along >= from && along <= to) return true;
  }
  return false;
}

bool is_stented(const TreatmentModel& model, const TreatmentState& s, int cell) {
  for (std::size_t i = 0; i < s.stents.size(); ++i) {
    const StentState& stent = s.stents[i];
    if (stent.where != StentState::deployed || stent.branch < 0) continue;
    const VesselPath& path = model.paths[static_cast<std::size_t>(stent.branch)];
    const auto at = std::find(path.cells.begin(), path.cells.end(), cell);
    if (at != path.cells.end() &&
        inner_radius_at(model.stents[i], stent, path.s_m[static_cast<std::size_t>(at - path.cells.begin())]) > 0)
      return true;
  }
  return false;
}

/// The longest path through a cell.
const VesselPath& path_through(const TreatmentModel& model, int cell) {
  const VesselPath* longest = &model.paths.front();
  double most_m = -1;
  for (const VesselPath& path : model.paths)
    if (path.length_m() > most_m && std::find(path.cells.begin(), path.cells.end(), cell) != path.cells.end())
      longest = &path, most_m = path.length_m();
  return *longest;
}

/// A flap narrows its artery over its length, where no stent holds it; a balloon pushes it aside.
void narrow_by_flaps(const TreatmentModel& model, const std::vector<double>& occupied_m, TreatmentState& s) {
  for (const Injury& injury : s.injury.injuries) {
    if (injury.cell < 0 || injury.kind != InjuryKind::dissection || injury.narrows < 1e-3) continue;
    const VesselPath& path = path_through(model, injury.cell);
    const auto torn = std::find(path.cells.begin(), path.cells.end(), injury.cell);
    const double torn_m = path.s_m[static_cast<std::size_t>(torn - path.cells.begin())];
    for (std::size_t k = 0; k < path.cells.size(); ++k) {
      const auto cell = static_cast<std::size_t>(path.cells[k]);
      const double beyond_m = path.s_m[k] - torn_m;
      if (beyond_m < -flap_m || beyond_m > flap_m + injury.runs_m || is_stented(model, s, path.cells[k])) continue;
      const double balloon = occupied_m.empty() ? 0 : occupied_m[cell];
      s.wall.radius_m[cell] =
          std::max(s.wall.radius_m[cell] * std::sqrt(1 - injury.narrows), std::min(balloon, s.wall.radius_m[cell]));
    }
  }
}

/// The jet out of the guide, with the lumen as the last step left it.
GuideJet jet_of(const TreatmentInputs& in, const FlowTree& tree, const std::vector<double>& occupied_m,
                const PhysiologyState& physiology) {
  GuideJet jet{.m3_s = in.injected_m3_s, .against_wall = std::clamp(in.tip_covered, 0.0, 1.0)};
  if (in.tip.where == TipPlace::coronary) {
    jet.cell = in.tip.cell;
    const auto cell = static_cast<std::size_t>(jet.cell);
    const double filled = occupied_m.empty() ? 0 : occupied_m[cell] / std::max(physiology.radius_m[cell], 1e-6);
    jet.against_wall = std::max(jet.against_wall, std::clamp((filled - fills_from) / (1 - fills_from), 0.0, 1.0));
  }
  const bool right = in.tip.where == TipPlace::right_sinus;
  if ((right || in.tip.where == TipPlace::left_sinus) && in.tip.into_ostium > 0.5)
    for (const FlowBranch& branch : tree.branches)
      if (branch.parent < 0 && (branch.territory == Territory::rca) == right) jet.cell = branch.first;
  return jet;
}

/// A jet against the wall tears it, and makes what is torn run on.
void inject(const TreatmentModel& model, const GuideJet& jet, const FlowTree& tree, double dt, double time_s,
            TreatmentState& s) {
  if (jet.cell < 0 || jet.m3_s <= 0) return;
  judge_jet(model.injury, jet, dt, time_s, s.injury);
  for (Injury& injury : s.injury.injuries)
    if (injury.cell >= 0 && !is_stented(model, s, injury.cell))
      run_on(jet, tree.is_downstream(injury.cell, jet.cell), dt, injury);
}

/// What lies over each hole, as the last step left the lumen.
void cover_holes(const TreatmentModel& model, const std::vector<double>& occupied_m, const PhysiologyState& physiology,
                 TreatmentState& s) {
  for (Injury& injury : s.injury.injuries) {
    if (injury.kind != InjuryKind::perforation || injury.cell < 0) continue;
    const auto cell = static_cast<std::size_t>(injury.cell);
    const bool balloon = !occupied_m.empty() && occupied_m[cell] > physiology.radius_m[cell] - tight_m;
    injury.covered = balloon || is_under_membrane(model, s, injury.cell);
  }
}

/// Branches that leave an artery under a covered stent are closed.
void close_branches(const TreatmentModel& model, const FlowTree& tree, const TreatmentState& s,
                    PhysiologyState& physiology) {
  bool any = false;
  for (std::size_t i = 0; i < s.stents.size(); ++i)
    any = any || (model.stents[i].covered && s.stents[i].where == StentState::deployed);
  if (!any) return;
  for (const FlowBranch& branch : tree.branches)
    if (branch.parent_cell >= 0 && tree.cells[static_cast<std::size_t>(branch.parent_cell)].branch == branch.parent &&
        branch.parent_cell + 1 < tree.branches[static_cast<std::size_t>(branch.parent)].last &&
        is_under_membrane(model, s, branch.parent_cell))
      physiology.radius_m[static_cast<std::size_t>(branch.first)] = closed_m;
}

/// Calls `narrow` with each cell of a mouth of that length, and the share of the way along it, where no stent holds it.
template <class Narrow>
void along_mouth(const TreatmentModel& model, const FlowTree& tree, const TreatmentState& s, int first, double length_m,
                 const Narrow& narrow) {
  if (is_stented(model, s, first)) return;
  const int last = tree.branches[static_cast<std::size_t>(tree.cells[static_cast<std::size_t>(first)].branch)].last;
  for (int c = first; c < last; ++c) {
    const double way = (tree.s_of(c) - tree.s_of(first)) / length_m;
    if (way >= 1) return;
    narrow(static_cast<std::size_t>(c), way);
  }
}

/// A carina in a branch's mouth narrows it, less and less along it; so does plaque that was pushed there.
void narrow_mouths(const TreatmentModel& model, const FlowTree& tree, const TreatmentState& s,
                   PhysiologyState& physiology) {
  for (std::size_t f = 0; f < model.forks.size(); ++f) {
    const Fork& fork = model.forks[f];
    const double shift_m = std::fabs(s.carina_m[f]);
    if (shift_m >= least_shift_m)
      along_mouth(model, tree, s, s.carina_m[f] > 0 ? fork.side_cell : fork.main_cell, mouth_m,
                  [&](std::size_t c, double way) {
                    physiology.radius_m[c] *= mouth_left(physiology.radius_m[c], (1 - way) * shift_m);
                  });
    if (s.in_mouth_m3[f] > 0)
      along_mouth(model, tree, s, fork.side_cell, plaque_reach_m, [&](std::size_t c, double way) {
        physiology.radius_m[c] *= mouth_beside_plaque(physiology.radius_m[c], s.in_mouth_m3[f], way);
      });
  }
}

void provoke(const TreatmentModel& model, const FlowTree& tree, const Provocation& what, TreatmentState& s,
             PhysiologyState& physiology) {
  const double time_s = physiology.heart.time_s;
  if (what.kind == Provoked::fibrillation) physiology.heart.rhythm = Rhythm::fibrillation;
  if (what.kind == Provoked::block) physiology.heart.rhythm = Rhythm::block;
  if (what.kind == Provoked::air) add_to_line(what.size, physiology.air);
  if (what.kind == Provoked::vagal) physiology.heart.circulation.vagal_reaction = std::clamp(what.size, 0.0, 1.0);
  if (what.cell < 0 || static_cast<std::size_t>(what.cell) >= tree.cells.size()) return;
  const int branch = tree.cells[static_cast<std::size_t>(what.cell)].branch;
  const double share = std::clamp(what.size, 0.0, 0.98);
  if (what.kind == Provoked::perforation)
    injure(model.injury, InjuryKind::perforation, what.cell, 3, what.size, time_s, s.injury);
  if (what.kind == Provoked::dissection)
    injure(model.injury, InjuryKind::dissection, what.cell, std::clamp(static_cast<int>(what.size), 0, 5), 0, time_s,
           s.injury);
  if (what.kind == Provoked::thrombus) form(model.thrombus, what.cell, what.size, s.thrombus);
  if (what.kind == Provoked::spasm) s.spasm[static_cast<std::size_t>(branch)] = share;
  if (what.kind == Provoked::no_reflow)
    for (std::size_t b = 0; b < tree.branches.size(); ++b)
      if (tree.is_downstream(tree.branches[b].first, tree.branches[static_cast<std::size_t>(branch)].first))
        physiology.flow.no_reflow[b] = share;
}

/// A shock ends fibrillation by a chance that falls with every minute without flow: 94 % at once, 64 % after some
/// (first shocks in hospital: OAEM 2017;9:9); an asystole it does not change.
void shock(const TreatmentModel& model, double joule, TreatmentState& s, PhysiologyState& physiology) {
  HeartState& heart = physiology.heart;
  s.shocks += 1;
  if (heart.rhythm == Rhythm::asystole) return;
  const double chance = 0.94 * std::exp(-heart.pulseless_s / 600) * std::min(1.0, joule / 120);
  if (heart.rhythm != Rhythm::fibrillation)
    heart.next_ectopic = true;
  else if (core::uniform(model.injury.seed, 51, static_cast<std::uint64_t>(s.shocks)) < chance)
    heart.rhythm = Rhythm::sinus;
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

/// Thrombus beside what lies in the lumen, which it then fills, too.
void clot(const TreatmentModel& model, const TreatmentInputs& in, double dt, TreatmentState& s,
          const TreatedVessels& vessels) {
  const ThrombusInputs around{act_s(model.drugs, s.drugs), vessels.flow, vessels.physiology.radius_m,
                              vessels.occupied_m,          in.tip,       in.drawn_m3_s};
  step(model.thrombus, around, dt, s.thrombus, vessels.physiology.flow);
  fill(model.thrombus, vessels.flow.tree, vessels.physiology.radius_m, s.thrombus, vessels.occupied_m);
}

}  // namespace

TreatmentState make_state(const TreatmentModel& model, const FlowTree& tree) {
  TreatmentState s;
  s.wall = make_plaque_state(model.plaque);
  for (BalloonState& balloon : s.balloons) {
    balloon.radius_m.assign(balloon_spheres, 0), balloon.flat_rad = balloon.radius_m;
    balloon.aside_m.assign(balloon_spheres, Eigen::Vector2d::Zero());
  }
  for (const StentModel& stent : model.stents) s.stents.push_back(make_stent_state(stent));
  s.carina_m.assign(model.forks.size(), 0), s.pushed_m3 = s.in_mouth_m3 = s.carina_m;
  s.spasm.assign(tree.branches.size(), 0);
  s.drugs = make_state(model.drugs);
  return s;
}

TreatmentReport step(const TreatmentModel& model, const TreatmentInputs& in, double dt, TreatmentState& s,
                     const TreatedVessels& vessels, TreatmentScratch& x) {
  TreatmentReport report;
  step(model.drugs, in.doses, dt, s.drugs);
  if (in.provocation.kind != Provoked::nothing)
    provoke(model, vessels.flow.tree, in.provocation, s, vessels.physiology);
  if (in.shock_J > 0) shock(model, in.shock_J, s, vessels.physiology);
  if (const double opens = opens_muscle(model.drugs, s.drugs); opens > 0)
    for (double& lost : vessels.physiology.flow.no_reflow) lost *= std::exp(-dt * opens / muscle_opens_s);
  for (double& spasm : s.spasm) spasm *= std::exp(-dt * s.drugs.nitrate / model.drugs.spasm_yields_s);
  std::copy(s.wall.rest_m.begin(), s.wall.rest_m.end(), s.wall.radius_m.begin());
  const int injured = s.injury.count;
  for (int k = 0; k < most_balloons; ++k) {
    change_balloon(model, in.balloons[k], k, s);
    report.blocked[k] = is_blocked(model, in.balloons[k], s.balloons[k], s.stents);
    if (report.blocked[k]) s.balloons[k].held = false;
  }
  for (int k = 0; k < most_balloons; ++k)
    if (in.balloons[k].balloon >= 0 && !report.blocked[k])
      report.balloons[k] = inflate(model, in, report, k, dt, s, vessels, x);
  step_stents(model, in, report, dt, s);
  move_forks(model, in, report, vessels.flow.tree, s);
  if (in.wire_tip_cell >= 0)
    judge_wire(model.injury, in.wire_tip_cell, s.wall.radius_m[in.wire_tip_cell], in.wire_tip_N, dt,
               vessels.physiology.heart.time_s, s.injury);
  if (in.injected_m3_s > 0)
    inject(model, jet_of(in, vessels.flow.tree, vessels.occupied_m, vessels.physiology), vessels.flow.tree, dt,
           vessels.physiology.heart.time_s, s);
  report.tore = s.injury.count > injured;
  fill_lumen(model, in, report, s, vessels);
  if (s.injury.count > 0) narrow_by_flaps(model, vessels.occupied_m, s);
  set_radii(model, vessels.flow.tree, s, vessels.physiology);
  narrow_mouths(model, vessels.flow.tree, s, vessels.physiology);
  close_branches(model, vessels.flow.tree, s, vessels.physiology);
  clot(model, in, dt, s, vessels);
  if (s.injury.count > 0) cover_holes(model, vessels.occupied_m, vessels.physiology, s);
  run_injuries(model, vessels.flow.tree, dt, s, vessels.physiology);
  return report;
}

double leak_m3_s(const TreatmentState& state) {
  double sum = 0;
  for (const Injury& injury : state.injury.injuries) sum += injury.leak_m3_s;
  return sum;
}

}  // namespace ostium::vascular
