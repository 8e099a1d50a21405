#include <algorithm>
#include <cmath>
#include <optional>

#include "app/session/coupling/looks.h"
#include "app/session/coupling/tool_geometry.h"
#include "core/rod/introducer.h"

namespace ostium::app {

using Eigen::Vector3d;

namespace {

constexpr double catch_angle_rad = 0.35;  // between guide and shaft at which a crimped stent's edge hangs [estimate]

/// Balloons that came out leave their places, those that came in take one. Of more than there are places for, the
/// first.
void take_places(const CouplingModel& model, const core::State& rods, CouplingState& s) {
  const auto is_inside = [&](std::size_t t) { return in_body(model.rods.rods[t], rods.rods[t]); };
  for (CoupledBalloon& own : s.balloons)
    if (own.tool >= 0 && !is_inside(static_cast<std::size_t>(own.tool))) own.tool = own.balloon = own.branch = -1;
  const int other = vascular::most_balloons - 1 - s.first;
  if (s.balloons[s.first].tool < 0 && s.balloons[other].tool >= 0) s.first = other;
  for (std::size_t t = 0; t < model.tools.size(); ++t) {
    if (model.balloon_of[t] < 0 || place_of(s, static_cast<int>(t)) >= 0 || !is_inside(t)) continue;
    for (CoupledBalloon& own : s.balloons)
      if (own.tool < 0) {
        own.tool = static_cast<int>(t), own.balloon = model.balloon_of[t], own.branch = -1;
        own.stent_out = own.caught = false, own.caught_N = 0;
        break;
      }
  }
}

/// The artery's cell at the tip of the wire that the tool runs over; -1: none.
int cell_of_its_wire(const CouplingModel& model, const core::State& rods, int tool, const CouplingScratch& x) {
  for (const core::Nesting& n : model.rods.nestings)
    if (n.outer == tool && is_thin_wire(model.tools[static_cast<std::size_t>(n.inner)].instrument))
      if (const int cell = cell_at_tip(model, rods, n.inner, x); cell >= 0) return cell;
  return -1;
}

/// Of a device whose proximal marker is by the ostium or in the aorta: by the distal one. Empty if the device lies
/// farther in, or less than `least_m` of it is in the artery. What of it stands out of the ostium meets a wall as wide
/// as that.
std::optional<vascular::Seat> seat_at_ostium(const CouplingModel& model, const vascular::CellLocator& locator,
                                             const Vector3d& p_far, double between_m, double least_m, int wire_cell) {
  const vascular::FlowTree& tree = model.physiology.flow.tree;
  const vascular::CellLocator::Found far = inside(locator, tree, model.treatment.paths, p_far, wire_cell);
  if (far.cell < 0) return {};
  const vascular::FlowCell& cell = tree.cells[static_cast<std::size_t>(far.cell)];
  const vascular::VesselPath& path = model.treatment.paths[static_cast<std::size_t>(cell.branch)];
  const auto at = std::find(path.cells.begin(), path.cells.end(), far.cell) - path.cells.begin();
  const double far_m = path.s_m[static_cast<std::size_t>(at)] + far.along_m;
  if (far_m > between_m || far_m < least_m) return {};
  return vascular::Seat{.branch = cell.branch, .middle_m = far_m - between_m / 2, .offset_m = far.distance_m};
}

/// How the shaft and the artery lie at each of the balloon's spheres.
void find_shaft(const CouplingModel& model, const core::State& rods, int tool, const vascular::LumenMoment& moment,
                const CouplingScratch& x, CoupledBalloon& s) {
  const auto t = static_cast<std::size_t>(tool);
  const vascular::VesselPath& path = model.treatment.paths[static_cast<std::size_t>(s.branch)];
  const vascular::BalloonModel& own = model.treatment.balloons[static_cast<std::size_t>(s.balloon)];
  const data::Instrument& instrument = model.tools[t].instrument;
  const double near_m = marker_from_tip_m(instrument, 0) + own.shoulder_m,
               far_m = std::max(0.0, marker_from_tip_m(instrument, 1) - own.shoulder_m);
  const double first_m = s.middle_m - own.length_m / 2 - own.shoulder_m;
  vascular::PathFrames frames(model.vessel.coronaries->map, path, first_m, moment);
  for (std::size_t i = 0; i < vascular::balloon_spheres; ++i) {
    const double part = static_cast<double>(i) / (vascular::balloon_spheres - 1),
                 at_m = first_m + spacing_m(own) * static_cast<double>(i);
    const vascular::PathFrame frame = frames.go_to(at_m);
    const auto across = [&](const Vector3d& v) { return Eigen::Vector2d(v.dot(frame.side), v.dot(frame.up)); };
    const Vector3d p = point_from_tip(model.rods.rods[t], rods.rods[t], near_m + part * (far_m - near_m));
    s.aside_m[i] = across(p - frame.centre);
    const int k = std::clamp(path.at(at_m).index, 1, static_cast<int>(path.cells.size()) - 2);
    const auto centre = [&](int index) -> const Vector3d& {
      return x.locator.centre(path.cells[static_cast<std::size_t>(index)]);
    };
    s.bend_1_m[i] = across(vascular::curvature_of(centre(k - 1), centre(k), centre(k + 1)));
  }
}

void look_at_balloon(const CouplingModel& model, const core::State& rods, const vascular::BalloonState& state,
                     bool is_new, const core::StepReport& report, const vascular::LumenMoment& moment,
                     CouplingScratch& x, CoupledBalloon& s) {
  const int was_branch = s.branch;
  s.branch = -1, s.drag_N = 0;
  if (s.tool < 0) return;
  const int t = s.tool;
  const bool held = !is_new && state.held;
  const core::Rod& rod = model.rods.rods[static_cast<std::size_t>(t)];
  const core::RodState& own = rods.rods[static_cast<std::size_t>(t)];
  const data::Instrument& instrument = model.tools[static_cast<std::size_t>(t)].instrument;
  const double near_m = marker_from_tip_m(instrument, 0), far_m = marker_from_tip_m(instrument, 1);
  if (own.inserted_m < near_m) return;
  const Vector3d p_near = point_from_tip(rod, own, near_m), p_far = point_from_tip(rod, own, far_m);
  const double between_m = near_m - far_m;
  int wire_cell = cell_of_its_wire(model, rods, t, x);
  if (wire_cell < 0 && was_branch >= 0)
    wire_cell = model.physiology.flow.tree.branches[static_cast<std::size_t>(was_branch)].last - 1;
  auto seat = seat_at_ostium(model, x.locator, p_far, between_m, held ? 0 : between_m / 2, wire_cell);
  if (!seat) seat = seat_of(x.locator, model.physiology.flow.tree, model.treatment.paths, p_near, p_far, wire_cell);
  // What the wall holds is not let go of because a beat throws its shaft aside for a moment; nor does a balloon that is
  // open in a stent go into a side branch, which it would tear.
  const bool aside = !seat || seat->branch != was_branch;
  const bool stays =
      held || (!is_new && !is_empty(model.treatment.balloons[static_cast<std::size_t>(s.balloon)], state));
  if (aside && stays && was_branch >= 0 && x.locator.nearest(p_far, near_heart_m).cell >= 0) {
    s.branch = was_branch;
    return;
  }
  if (!seat) return;
  s.branch = seat->branch, s.middle_m = seat->middle_m;
  if (held || state.pressure_Pa > 0) find_shaft(model, rods, t, moment, x, s);
  const Vector3d along = (p_far - p_near).normalized();
  for (const core::Touch& touch : report.touches) {
    if (touch.rod != t) continue;
    const double from_tip = rod.node_from_tip_m[static_cast<std::size_t>(touch.node)];
    if (from_tip >= far_m && from_tip <= near_m) s.drag_N += touch.friction_W_N.dot(along);
  }
}

void look_at_crimped_stent(const CouplingModel& model, const core::State& rods,
                           const vascular::TreatmentState& treatment, int guide_tool, CoupledBalloon& s) {
  s.caught_N = 0;
  const int own = s.balloon < 0 ? -1 : model.treatment.stent_on[static_cast<std::size_t>(s.balloon)];
  if (own < 0 || guide_tool < 0 ||
      treatment.stents[static_cast<std::size_t>(own)].where != vascular::StentState::on_balloon) {
    s.caught = s.stent_out = false;
    return;
  }
  const auto t = static_cast<std::size_t>(s.tool), g = static_cast<std::size_t>(guide_tool);
  const data::Instrument &instrument = model.tools[t].instrument, &guide = model.tools[g].instrument;
  const vascular::StentState& stent = treatment.stents[static_cast<std::size_t>(own)];
  const double out_m = rods.rods[t].inserted_m - rods.rods[g].inserted_m;
  const double inside_m = marker_from_tip_m(instrument, 0) - stent.shift_m - out_m;  // its proximal end, in the guide
  if (inside_m < -1e-3) s.stent_out = true;
  if (inside_m <= 0) s.caught = false;
  if (inside_m <= 0 || !s.stent_out) return;
  if (!s.caught) {
    constexpr double beyond_m = 4e-3, edge_m = 1e-3;  // what opens farther in does not hang on the edge
    const core::Rod& shaft = model.rods.rods[t];
    const Vector3d along = point_from_tip(shaft, rods.rods[t], std::max(0.0, out_m - beyond_m)) -
                           point_from_tip(shaft, rods.rods[t], out_m);
    const double angle =
        std::acos(std::clamp(along.normalized().dot(direction_at_tip(model.rods.rods[g], rods.rods[g])), -1.0, 1.0));
    const double widest = *std::max_element(stent.radius_m.begin(), stent.radius_m.end());
    const double strut = model.treatment.stents[static_cast<std::size_t>(own)].strut_m;
    if (inside_m < edge_m && (angle > catch_angle_rad || widest + strut > guide.inner_diameter_m / 2))
      s.caught = true;
    else if (inside_m > 2e-3)
      s.stent_out = false;  // it has found its way in
  }
  if (s.caught) s.caught_N = std::min(edge_N_m * inside_m, most_caught_N);
}

}  // namespace

void look_at_balloons(const CouplingModel& model, const core::State& rods, const vascular::TreatmentState& treatment,
                      const core::StepReport& report, const vascular::LumenMoment& moment, CouplingScratch& x,
                      CouplingState& s) {
  std::array<int, vascular::most_balloons> was{};
  for (std::size_t k = 0; k < was.size(); ++k) was[k] = s.balloons[k].tool;
  take_places(model, rods, s);
  for (std::size_t k = 0; k < was.size(); ++k)
    look_at_balloon(model, rods, treatment.balloons[k], was[k] != s.balloons[k].tool, report, moment, x, s.balloons[k]);
}

void look_at_crimped_stents(const CouplingModel& model, const core::State& rods,
                            const vascular::TreatmentState& treatment, CouplingState& s) {
  for (CoupledBalloon& own : s.balloons) look_at_crimped_stent(model, rods, treatment, s.guide, own);
}

}  // namespace ostium::app
