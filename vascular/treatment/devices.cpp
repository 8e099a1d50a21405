#include "vascular/treatment/devices.h"

#include <algorithm>
#include <cmath>

#include "vascular/treatment/plaque_shift.h"
#include "vascular/treatment/side_by_side.h"

namespace ostium::vascular {

namespace {

constexpr double endless_m = 1;                  // longer than any path
constexpr double least_sine2 = 0.1;              // of branches that hardly part
constexpr double pushes_from_Pa = 0.5 * 101325;  // with less in it a balloon moves no carina

const BalloonModel* balloon_of(const TreatmentModel& model, const PlacedBalloon& placed) {
  return placed.balloon >= 0 ? &model.balloons[placed.balloon] : nullptr;
}
const VesselPath* path_of(const TreatmentModel& model, const PlacedBalloon& placed) {
  return placed.branch >= 0 ? &model.paths[placed.branch] : nullptr;
}
/// The stent that is, or was, crimped on the balloon; -1 if none.
int own_stent(const TreatmentModel& model, const PlacedBalloon& placed) {
  return placed.balloon >= 0 ? model.stent_on[placed.balloon] : -1;
}

/// How far the balloon's vessel is that of a stent in the wall, along both; below 0: there is no such stent.
double beside_stent_to_m(const TreatmentModel& model, const PlacedBalloon& placed, const StentState& stent) {
  const VesselPath* path = path_of(model, placed);
  if (!path || stent.where != StentState::deployed || stent.branch < 0) return -1;
  const double to_m = common_m(model.paths[static_cast<std::size_t>(stent.branch)], *path);
  return to_m > span_of(stent).first ? to_m : -1;
}

/// The other balloon, where it lies beside balloon `k`.
Beside look_beside(const TreatmentModel& model, const TreatmentInputs& in, const TreatmentReport& report, int k,
                   const TreatmentState& s, TreatmentScratch& x) {
  x.beside_m.assign(balloon_spheres, 0);
  x.lumen_m.assign(s.balloons[k].radius_m.begin(), s.balloons[k].radius_m.end());
  const BalloonModel& own = *balloon_of(model, in.balloons[k]);
  const VesselPath* path = path_of(model, in.balloons[k]);
  double beside_to_m = -1;
  for (int other = 0; other < most_balloons && path; ++other) {
    const BalloonModel* its = balloon_of(model, in.balloons[other]);
    const VesselPath* its_path = path_of(model, in.balloons[other]);
    if (other == k || !its || !its_path || report.blocked[other]) continue;
    const double to_m = common_m(*path, *its_path);
    x.beside_aside_m.assign(balloon_spheres, Eigen::Vector2d::Zero());
    for (int i = 0; i < balloon_spheres; ++i) {
      const double at_m = sphere_position(own, s.balloons[k], i);
      if (at_m > to_m) break;
      x.beside_m[i] = radius_at(*its, s.balloons[other], at_m);
      if (x.beside_m[i] <= 0) continue;
      beside_to_m = to_m;
      x.beside_aside_m[i] = aside_at_m(*its, s.balloons[other], at_m);
      x.lumen_m[i] = side_by_side(s.balloons[k].radius_m[i], x.beside_m[i], s.balloons[k].flat_rad[i]).lumen_m;
    }
  }
  return beside_to_m < 0 ? Beside{} : Beside{x.beside_m, x.beside_aside_m, x.lumen_m, beside_to_m};
}

/// Releases the contents of a burst balloon into the vessel.
void spill(const VesselPath& path, double middle_m, double spilt_m3, double iodine_kg_m3, std::size_t cells,
           ContrastState& contrast) {
  const auto cell = static_cast<std::size_t>(path.cells[path.at(middle_m).index]);
  const double kg = spilt_m3 * iodine_kg_m3;
  for (int k = 0; k < layers; ++k) contrast.sheath_kg[k * cells + cell] += kg / layers;
  contrast.injected_kg += kg, contrast.injected_m3 += spilt_m3;
}

/// Where a balloon leaves the vessel that it shares with a stent, through the stent's wall.
ThroughCell way_through(const TreatmentModel& model, const PlacedBalloon& placed, const BalloonState& state,
                        double leaves_m) {
  const VesselPath& path = *path_of(model, placed);
  const int first = path.at(leaves_m).index + 1;
  if (first >= static_cast<int>(path.cells.size())) return {};
  for (const Fork& fork : model.forks)
    if (fork.side_cell == path.cells[static_cast<std::size_t>(first)])
      return {.radius_m = radius_at(*balloon_of(model, placed), state, path.s_m[static_cast<std::size_t>(first)]),
              .at_m = leaves_m,
              .angle_rad = fork.angle_rad,
              .longer = 1 / std::sqrt(std::max(least_sine2, 1 - fork.cosine * fork.cosine))};
  return {};
}

}  // namespace

void change_balloon(const TreatmentModel& model, const PlacedBalloon& placed, int k, TreatmentState& s) {
  BalloonState& balloon = s.balloons[k];
  if (s.balloon_in[k] != placed.balloon) {
    s.balloon_in[k] = placed.balloon;
    if (placed.balloon >= 0) balloon = make_balloon_state(model.balloons[placed.balloon]);
  }
  if (placed.balloon < 0) balloon.held = false;
  follow_shaft(placed.shaft.middle_m, balloon);
  // A crimped stent moves with its balloon; set before the balloon's step.
  if (const int own = own_stent(model, placed); own >= 0 && s.stents[own].where == StentState::on_balloon)
    s.stents[own].branch = placed.branch, s.stents[own].middle_m = balloon.seat_m;
}

bool is_blocked(const TreatmentModel& model, const PlacedBalloon& placed, const BalloonState& state,
                const std::vector<StentState>& stents) {
  const BalloonModel* balloon = balloon_of(model, placed);
  if (!balloon || !path_of(model, placed)) return false;
  const double end = state.seat_m + balloon->length_m / 2 + balloon->shoulder_m;
  for (std::size_t i = 0; i < stents.size(); ++i)
    if (const double to_m = beside_stent_to_m(model, placed, stents[i]);
        to_m >= 0 && narrowest_m(model.stents[i], stents[i], -1, std::min(end, to_m)) < balloon->folded_m)
      return true;
  return false;
}

BalloonReport inflate(const TreatmentModel& model, const TreatmentInputs& in, const TreatmentReport& so_far, int k,
                      double dt, TreatmentState& s, const TreatedVessels& vessels, TreatmentScratch& x) {
  const PlacedBalloon& placed = in.balloons[k];
  BalloonState& state = s.balloons[k];
  const BalloonModel& balloon = *balloon_of(model, placed);
  const VesselPath* path = path_of(model, placed);
  const int own = own_stent(model, placed);
  const bool whole = !state.burst;
  const Beside beside = look_beside(model, in, so_far, k, s, x);
  // Stents in the wall, and the one on this balloon; others are not in the vessel.
  Sleeve sleeve;
  for (std::size_t i = 0; i < s.stents.size(); ++i) {
    const bool mine = static_cast<int>(i) == own && s.stents[i].where == StentState::on_balloon;
    const double to_m = mine ? endless_m : beside_stent_to_m(model, placed, s.stents[i]);
    if (to_m >= 0) add_sleeve(model.stents[i], s.stents[i], {&balloon, &state, to_m}, x.lumen_m, x.stent, sleeve);
  }
  const BalloonReport report =
      step(balloon, model.plaque, {path, placed.shaft, placed.gauge_Pa, sleeve, beside}, dt, state, s.wall, x.balloon);
  if (report.touches || report.spilt_m3 > 0)
    judge_stretch(model.injury, model.plaque, s.wall, balloon.length_m, whole && state.burst,
                  vessels.physiology.heart.time_s, s.injury);
  if (report.spilt_m3 > 0 && path)
    spill(*path, state.seat_m, report.spilt_m3, balloon.iodine_kg_m3, vessels.flow.tree.cells.size(),
          vessels.physiology.contrast);
  return report;
}

void step_stents(const TreatmentModel& model, const TreatmentInputs& in, const TreatmentReport& report, double dt,
                 TreatmentState& s) {
  for (std::size_t i = 0; i < s.stents.size(); ++i) {
    StentState& stent = s.stents[i];
    StentInputs inputs{.edge_m = in.edge_m};
    std::array<BalloonInside, most_balloons> inside;
    std::size_t count = 0;
    bool carried = false;
    for (int k = 0; k < most_balloons; ++k) {
      const PlacedBalloon& placed = in.balloons[k];
      const bool mine = placed.balloon >= 0 && static_cast<int>(i) == own_stent(model, placed);
      const double beside_to_m = beside_stent_to_m(model, placed, stent);
      carried = carried || mine;
      if (mine) inputs.carried_by = &s.balloons[k], inputs.drag_N = placed.drag_N;
      if (beside_to_m >= 0) inputs.edge_N = in.edge_N;
      if (placed.balloon >= 0 && !report.blocked[k] && (mine || beside_to_m >= 0))
        inside[count++] = {balloon_of(model, placed), &s.balloons[k], mine ? endless_m : beside_to_m,
                           report.balloons[k].slid_m};
      if (placed.balloon >= 0 && !report.blocked[k] && beside_to_m >= 0 && beside_to_m < endless_m)
        inputs.through = way_through(model, placed, s.balloons[k], beside_to_m);
    }
    if (stent.where == StentState::lost || (stent.where == StentState::on_balloon && !carried)) continue;
    inputs.path = stent.branch >= 0 ? &model.paths[static_cast<std::size_t>(stent.branch)] : nullptr;
    inputs.inside = {inside.data(), count};
    step(model.stents[i], model.plaque, inputs, dt, stent, s.wall);
  }
}

void move_forks(const TreatmentModel& model, const TreatmentInputs& in, const TreatmentReport& report,
                const FlowTree& tree, TreatmentState& s) {
  for (std::size_t f = 0; f < model.forks.size(); ++f) {
    AtFork there;
    bool filled = false;
    for (int k = 0; k < most_balloons; ++k) {
      const BalloonModel* balloon = balloon_of(model, in.balloons[k]);
      const VesselPath* path = path_of(model, in.balloons[k]);
      if (!balloon || !path || report.blocked[k] || s.balloons[k].pressure_Pa < pushes_from_Pa) continue;
      filled = true;
      const auto radius_in = [&](int cell) {
        const auto at = std::find(path->cells.begin(), path->cells.end(), cell) - path->cells.begin();
        return at == std::ssize(path->cells)
                   ? 0.0
                   : radius_at(*balloon, s.balloons[k], path->s_m[static_cast<std::size_t>(at)]);
      };
      there.main_m = std::max(there.main_m, radius_in(model.forks[f].main_cell));
      there.side_m = std::max(there.side_m, radius_in(model.forks[f].side_cell));
    }
    if (there.main_m > 0 || there.side_m > 0)
      s.carina_m[f] = shifted_carina_m(tree, model.forks[f], there, s.carina_m[f]);
    if (!filled) continue;
    const double pushed_m3 = pushed_plaque_m3(tree, model.plaque, s.wall, model.forks[f]);
    s.in_mouth_m3[f] += pushed_m3 - s.pushed_m3[f], s.pushed_m3[f] = pushed_m3;
    s.in_mouth_m3[f] = plaque_left_m3(tree, model.forks[f], s.in_mouth_m3[f], there.side_m);
  }
}

void fill_lumen(const TreatmentModel& model, const TreatmentInputs& in, const TreatmentReport& report,
                const TreatmentState& s, const TreatedVessels& vessels) {
  std::vector<double>& occupied_m = vessels.occupied_m;
  if (in.shaft_m.empty())
    occupied_m.assign(vessels.flow.tree.cells.size(), 0);
  else
    occupied_m.assign(in.shaft_m.begin(), in.shaft_m.end());
  for (int k = 0; k < most_balloons; ++k) {
    const BalloonModel* balloon = balloon_of(model, in.balloons[k]);
    const VesselPath* path = path_of(model, in.balloons[k]);
    if (!balloon || !path || report.blocked[k]) continue;
    // Where another lies beside it, what the wall is drawn round is full.
    std::array<BalloonInside, most_balloons> there{BalloonInside{balloon, &s.balloons[k], endless_m}};
    std::size_t count = 1;
    for (int other = 0; other < k; ++other)
      if (const VesselPath* its = path_of(model, in.balloons[other]);
          its && balloon_of(model, in.balloons[other]) && !report.blocked[other])
        there[count++] = {balloon_of(model, in.balloons[other]), &s.balloons[other], common_m(*path, *its)};
    for (std::size_t c = 0; c < path->cells.size(); ++c) {
      double& occupied = occupied_m[path->cells[c]];
      occupied = std::max(occupied, opened_to({there.data(), count}, path->s_m[c]).radius_m);
    }
  }
}

}  // namespace ostium::vascular
