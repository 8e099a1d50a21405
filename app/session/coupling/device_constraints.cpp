#include "app/session/coupling/device_constraints.h"

#include <algorithm>

#include "app/session/coupling/tool_geometry.h"
#include "vascular/treatment/stent_shape.h"

namespace ostium::app {

using Eigen::Vector3d;

namespace {

constexpr double anchor_N_m = 1000;  // an open balloon to its place: shaft and artery give [estimate]
constexpr double most_held_N = 3;    // a shaft kinks at higher force [estimate]
constexpr double on_guide_m = 3e-3;  // length at the guide's tip that a stent pushes on

/// The path's frame at that moment; the path is extended straight beyond its ends.
vascular::PathFrame place_of(const CouplingModel& model, const CouplingState& s, const vascular::LumenMoment& moment) {
  const vascular::VesselPath& path = model.treatment.paths[static_cast<std::size_t>(s.branch)];
  vascular::PathFrame frame = frame_at(model.vessel.coronaries->map, path, s.anchor_m, moment);
  frame.centre += (s.anchor_m - std::clamp(s.anchor_m, path.s_m.front(), path.s_m.back())) * frame.along;
  return frame;
}

std::size_t tool_of(const CouplingModel& model, const CouplingState& s) {
  const auto at = std::find(model.balloon_of.begin(), model.balloon_of.end(), s.balloon);
  return static_cast<std::size_t>(at - model.balloon_of.begin());
}

double middle_from_tip_m(const data::Instrument& instrument) {
  return (marker_from_tip_m(instrument, 0) + marker_from_tip_m(instrument, 1)) / 2;
}

}  // namespace

void hold_balloon(const CouplingModel& model, const core::State& rods, const vascular::BalloonReport& report,
                  const vascular::LumenMoment& moment, CouplingState& s) {
  if (s.balloon < 0 || s.branch < 0 || !(report.pressed_N > 0)) {
    s.held = false;
    return;
  }
  if (!s.held) s.held = true, s.anchor_m = s.middle_m;
  const std::size_t t = tool_of(model, s);
  const vascular::BalloonModel& own = model.treatment.balloons[static_cast<std::size_t>(s.balloon)];
  const Vector3d p = point_from_tip(model.rods.rods[t], rods.rods[t], middle_from_tip_m(model.tools[t].instrument));
  const vascular::PathFrame frame = place_of(model, s, moment);
  const double off_m = (p - frame.centre).dot(frame.along);
  const double bears_m = std::min(own.friction * report.pressed_N, most_held_N) / anchor_N_m;
  s.anchor_m += off_m - std::clamp(off_m, -bears_m, bears_m);
}

core::Tether tether_on_shaft(const CouplingModel& model, const vascular::TreatmentState& treatment,
                             const CouplingState& s, int tool, const vascular::LumenMoment& moment) {
  const auto t = static_cast<std::size_t>(tool);
  if (!s.held || model.balloon_of[t] < 0 || model.balloon_of[t] != s.balloon) return {};
  const vascular::BalloonModel& own = model.treatment.balloons[static_cast<std::size_t>(s.balloon)];
  const vascular::PathFrame frame = place_of(model, s, moment);
  // A balloon that slides along the artery pulls its shaft with it.
  const double drawn_N = std::clamp(own.grip_N_m * treatment.balloon.slip_m, -most_held_N, most_held_N);
  return {middle_from_tip_m(model.tools[t].instrument), frame.centre + drawn_N / anchor_N_m * frame.along, frame.along,
          anchor_N_m};
}

core::StretchLoad load_on_shaft(const CouplingModel& model, const core::State& rods, const CouplingState& s, int tool) {
  const auto t = static_cast<std::size_t>(tool);
  const core::Rod& rod = model.rods.rods[t];
  const core::RodState& own = rods.rods[t];
  if (tool == s.guide && s.edge_push_N > 0) return {0, on_guide_m, -s.edge_push_N * direction_at_tip(rod, own)};
  if (s.caught_N == 0 || s.balloon < 0 || model.balloon_of[t] != s.balloon) return {};
  const data::Instrument& instrument = model.tools[t].instrument;
  const double near_m = marker_from_tip_m(instrument, 0), far_m = marker_from_tip_m(instrument, 1);
  const Vector3d along = point_from_tip(rod, own, far_m) - point_from_tip(rod, own, near_m);
  if (!(along.norm() > 1e-6)) return {};
  return {far_m, near_m, s.caught_N * along.normalized()};
}

}  // namespace ostium::app
