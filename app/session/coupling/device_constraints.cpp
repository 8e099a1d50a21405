#include "app/session/coupling/device_constraints.h"

#include <algorithm>
#include <cmath>

#include "app/session/coupling/tool_geometry.h"
#include "vascular/treatment/stent_shape.h"

namespace ostium::app {

using Eigen::Vector3d;

namespace {

constexpr double on_guide_m = 3e-3;  // length at the guide's tip that a stent pushes on

/// The path is extended straight beyond its ends.
vascular::PathPoint point_of(const CouplingModel& model, const CoupledBalloon& s, double at_m,
                             const vascular::LumenMoment& moment) {
  const vascular::VesselPath& path = model.treatment.paths[static_cast<std::size_t>(s.branch)];
  vascular::PathPoint point = point_at(model.vessel.coronaries->map, path, at_m, moment);
  point.centre += (at_m - std::clamp(at_m, path.s_m.front(), path.s_m.back())) * point.along;
  return point;
}

}  // namespace

double ahead_of_shaft_m(const CouplingModel& model, const core::State& rods, const vascular::BalloonState& body,
                        const CoupledBalloon& s, const vascular::LumenMoment& moment) {
  const auto t = static_cast<std::size_t>(s.tool);
  const data::Instrument& instrument = model.tools[t].instrument;
  const double near_m = marker_from_tip_m(instrument, 0), far_m = marker_from_tip_m(instrument, 1);
  const auto ahead_m = [&](double from_tip_m) {
    const double at_m = body.seat_m + (near_m + far_m) / 2 - from_tip_m;
    const vascular::PathPoint there = point_of(model, s, at_m, moment);
    return (there.centre - point_from_tip(model.rods.rods[t], rods.rods[t], from_tip_m)).dot(there.along);
  };
  return (ahead_m(near_m) + ahead_m(far_m)) / 2;
}

std::array<core::Tether, core::max_tethers> tethers_on_shaft(const CouplingModel& model, const core::State& rods,
                                                             const vascular::TreatmentState& treatment,
                                                             const CouplingState& s, int tool,
                                                             const vascular::LumenMoment& moment) {
  const int place = place_of(s, tool);
  if (place < 0 || s.balloons[place].branch < 0 || !treatment.balloons[place].held) return {};
  const auto t = static_cast<std::size_t>(tool);
  const vascular::BalloonState& body = treatment.balloons[place];
  const vascular::BalloonModel& own = model.treatment.balloons[static_cast<std::size_t>(s.balloons[place].balloon)];
  const data::Instrument& instrument = model.tools[t].instrument;
  const double middle_m = (marker_from_tip_m(instrument, 0) + marker_from_tip_m(instrument, 1)) / 2;
  const double ahead_m = ahead_of_shaft_m(model, rods, body, s.balloons[place], moment);
  // Aside, the shaft is not pulled: contact's wall lags the lumen that the balloon opens, and what pulls a shaft
  // towards the one presses it into the other.
  const Vector3d along = point_of(model, s.balloons[place], body.seat_m, moment).along;
  const Vector3d p = point_from_tip(model.rods.rods[t], rods.rods[t], middle_m);
  // What wall and shaft have moved since the body's last step does not pull more than friction holds.
  const double pulls_N = own.bond_N_m * std::fabs(ahead_m);
  const double share = pulls_N > body.holds_N ? body.holds_N / pulls_N : 1;
  return {core::Tether{middle_m, p + ahead_m * along, along, share * own.bond_N_m, 0}};
}

core::StretchLoad load_on_shaft(const CouplingModel& model, const core::State& rods, const CouplingState& s, int tool) {
  const auto t = static_cast<std::size_t>(tool);
  const core::Rod& rod = model.rods.rods[t];
  const core::RodState& own = rods.rods[t];
  if (tool == s.guide && s.edge_push_N > 0) return {0, on_guide_m, -s.edge_push_N * direction_at_tip(rod, own)};
  const int place = place_of(s, tool);
  if (place < 0 || s.balloons[place].caught_N == 0) return {};
  const data::Instrument& instrument = model.tools[t].instrument;
  const double near_m = marker_from_tip_m(instrument, 0), far_m = marker_from_tip_m(instrument, 1);
  const Vector3d along = point_from_tip(rod, own, far_m) - point_from_tip(rod, own, near_m);
  if (!(along.norm() > 1e-6)) return {};
  return {far_m, near_m, s.balloons[place].caught_N * along.normalized()};
}

}  // namespace ostium::app
