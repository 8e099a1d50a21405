#include "app/session/coupling/coupling.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/units.h"
#include "core/rod/introducer.h"
#include "data/assessment/metrics.h"
#include "data/formats/load_error.h"
#include "vascular/motion/heart_cycle.h"

namespace ostium::app {

using Eigen::Vector3d;

namespace {

constexpr double near_heart_m = 6e-3;     // of the box about all cells
constexpr double tip_m = 3e-3;            // what of a wire is its tip
constexpr double thick_wire_m = 0.35e-3;  // radius; 0.035 in wires
constexpr double irritates_m = 10e-3;     // beyond the valve at which a wire surely meets the ventricle's wall
constexpr double edge_s = 0.02;           // in which a stent's push on the guide comes and goes
constexpr double irritates_N = 0.05;   // of a wire on the ventricle's wall that surely gives extrasystoles [estimate]
constexpr double at_valve_m = 4.5e-3;  // above the annulus within which a tip may be on its way through the valve
constexpr double catch_angle_rad = 0.35;  // between guide and shaft at which a crimped stent's edge hangs [estimate]
constexpr double edge_N_m = 500;          // of a guide's edge against a stent [estimate]
constexpr double most_caught_N = 5;       // a balloon's shaft tears soon beyond [estimate]
constexpr double in_vessel = 1.6;         // radii from a centreline within which a point counts as inside
constexpr double manifold_m3 = 0.3e-6;    // of the line ahead of the guide

/// The first catheter in the body; the outermost.
int guide_of(const CouplingModel& model, const core::State& rods) {
  for (std::size_t t = 0; t < model.tools.size(); ++t)
    if (is_catheter(model.tools[t].instrument) && in_body(model.rods.rods[t], rods.rods[t])) return static_cast<int>(t);
  return -1;
}

/// In the body, with its tip beyond the guide's or the guide gone.
int balloon_tool(const CouplingModel& model, const core::State& rods) {
  for (std::size_t t = 0; t < model.tools.size(); ++t)
    if (model.balloon_of[t] >= 0 && in_body(model.rods.rods[t], rods.rods[t])) return static_cast<int>(t);
  return -1;
}

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

void look_at_balloon(const CouplingModel& model, const core::State& rods, const vascular::TreatmentState& treatment,
                     const core::StepReport& report, CouplingScratch& x, CouplingState& s) {
  const int t = balloon_tool(model, rods);
  const int was = s.balloon, was_branch = s.branch;
  s.balloon = t < 0 ? -1 : model.balloon_of[static_cast<std::size_t>(t)];
  s.branch = -1, s.drag_N = 0;
  if (s.balloon != was) s.held = s.stent_out = s.caught = false, s.caught_N = 0;
  if (t < 0) return;
  const core::Rod& rod = model.rods.rods[static_cast<std::size_t>(t)];
  const core::RodState& own = rods.rods[static_cast<std::size_t>(t)];
  const data::Instrument& instrument = model.tools[static_cast<std::size_t>(t)].instrument;
  const double near_m = marker_from_tip_m(instrument, 0), far_m = marker_from_tip_m(instrument, 1);
  if (own.inserted_m < near_m) return;
  const Vector3d p_near = point_from_tip(rod, own, near_m), p_far = point_from_tip(rod, own, far_m);
  const double between_m = near_m - far_m;
  const int wire_cell = s.wire_cell;
  auto seat = seat_at_ostium(model, x.locator, p_far, between_m, s.held ? 0 : between_m / 2, wire_cell);
  if (!seat) seat = seat_of(x.locator, model.physiology.flow.tree, model.treatment.paths, p_near, p_far, wire_cell);
  // What the wall holds is not let go of because a beat throws its shaft aside for a moment; nor does a balloon that is
  // open in a stent go into a side branch, which it would tear.
  const bool aside = !seat || seat->branch != was_branch;
  const bool stays =
      s.held ||
      (s.balloon == was && !is_empty(model.treatment.balloons[static_cast<std::size_t>(s.balloon)], treatment.balloon));
  if (aside && stays && was_branch >= 0 && x.locator.nearest(p_far, near_heart_m).cell >= 0) {
    s.branch = was_branch;
    return;
  }
  if (!seat) return;
  s.branch = seat->branch, s.middle_m = seat->middle_m;
  const Vector3d along = (p_far - p_near).normalized();
  for (const core::Touch& touch : report.touches) {
    if (touch.rod != t) continue;
    const double from_tip = rod.node_from_tip_m[static_cast<std::size_t>(touch.node)];
    if (from_tip >= far_m && from_tip <= near_m) s.drag_N += touch.friction_W_N.dot(along);
  }
}

void look_at_guide(const CouplingModel& model, const core::State& rods, const core::StepReport& report, double phase,
                   double breath, const Vector3d& root_shift, CouplingScratch& x, CouplingState& s) {
  const int g = guide_of(model, rods);
  s.guide = g;
  s.tip = {}, s.covered = s.filled_m = 0, s.in_ventricle = s.thick_wire = false;
  if (g < 0) return;
  const core::Rod& rod = model.rods.rods[static_cast<std::size_t>(g)];
  const core::RodState& own = rods.rods[static_cast<std::size_t>(g)];
  const Vector3d p = own.position[rod.elements], direction = direction_at_tip(rod, own);
  const vascular::Patient& patient = *model.vessel.patient;
  s.tip = tip_place(x.locator, model.physiology.flow.tree, model.physiology.contrast, patient,
                    model.vessel.coronaries->map, phase, breath, p, direction);
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

/// A crimped stent that is drawn back into the guide hangs on its edge if the shaft leaves the guide at an angle, or if
/// it is no longer crimped. The edge holds it; what it cannot be pulled off its balloon with, the shaft feels.
void look_at_crimped_stent(const CouplingModel& model, const core::State& rods,
                           const vascular::TreatmentState& treatment, CouplingState& s) {
  s.caught_N = 0;
  const int own = s.balloon < 0 ? -1 : model.treatment.stent_on[static_cast<std::size_t>(s.balloon)];
  if (own < 0 || s.guide < 0 ||
      treatment.stents[static_cast<std::size_t>(own)].where != vascular::StentState::on_balloon) {
    s.caught = s.stent_out = false;
    return;
  }
  const auto t = static_cast<std::size_t>(balloon_tool(model, rods)), g = static_cast<std::size_t>(s.guide);
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

/// A guide that goes so deep that it meets a stent in the wall pushes its end, if it does not lie in the middle of it.
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

/// Whether a point is in the ventricle as it is at that phase and depth of breath.
bool in_ventricle(const Vessel& vessel, double phase, double breath, const Vector3d& p_P) {
  const vascular::Ventricle& v = vessel.ventricle;
  if (v.spheres.empty()) return false;
  const Vector3d p = p_P - vascular::HeartMotion(vessel.patient->anatomy.landmarks).breath_displacement(p_P, breath);
  const auto frames = static_cast<double>(v.centres.size());
  const auto& centres = v.centres[static_cast<std::size_t>(std::lround(phase * frames)) % v.centres.size()];
  for (std::size_t k = 0; k < centres.size(); ++k)
    if ((p - centres[k]).norm() < v.spheres[k].radius_m + 1e-3) return true;
  return false;
}

void look_at_valve(const CouplingModel& model, const core::State& rods, const core::StepReport& report, double phase,
                   double breath, const Vector3d& root_shift, CouplingState& s) {
  const vascular::Landmarks& marks = model.vessel.patient->anatomy.landmarks;
  bool through = false;
  for (std::size_t t = 0; t < model.tools.size(); ++t) {
    const core::Rod& rod = model.rods.rods[t];
    if (!in_body(rod, rods.rods[t]) || rod.radius.at(0)[rod.elements] > vascular::valve_passes_m) continue;
    const Vector3d p = rods.rods[t].position[rod.elements], from = p - root_shift - marks.p_annulus;
    const double above_m = from.dot(marks.root_axis), aside_m = (from - above_m * marks.root_axis).norm();
    const bool inside = in_ventricle(model.vessel, phase, breath, p);
    // The valve stays open only for what came while it was.
    if (vascular::valve_is_open(phase) || s.through_valve)
      through = through || inside || (aside_m < vascular::valve_radius_m + 1e-3 && std::fabs(above_m) < at_valve_m);
    if (!inside) continue;
    double pressed_N = 0;
    for (const core::Touch& touch : report.touches)
      if (touch.rod == static_cast<int>(t) && in_ventricle(model.vessel, phase, breath, touch.p_W))
        pressed_N += touch.normal_W_N.norm();
    s.irritation = std::max(s.irritation, std::min(1.0, pressed_N / irritates_N));
  }
  s.through_valve = through && !model.vessel.ventricle.spheres.empty();
}

bool is_thin_wire(const data::Instrument& i) {
  return i.kind == data::InstrumentKind::wire && i.outer_diameter_m < 2 * thick_wire_m;
}

void look_at_wires(const CouplingModel& model, const core::State& rods, const Vector3d& root_shift, CouplingScratch& x,
                   CouplingState& s) {
  s.irritation = 0, s.wire_cell = -1;
  const vascular::FlowTree& tree = model.physiology.flow.tree;
  for (std::size_t t = 0; t < model.tools.size(); ++t) {
    const core::Rod& rod = model.rods.rods[t];
    const core::RodState& own = rods.rods[t];
    if (!in_body(rod, own)) continue;
    const Vector3d p = own.position[rod.elements];
    const vascular::CellLocator::Found f = x.locator.nearest(p, near_heart_m);
    const bool in_artery = f.cell >= 0 && f.distance_m < in_vessel * tree.cells[f.cell].healthy_m;
    const vascular::Landmarks& marks = model.vessel.patient->anatomy.landmarks;
    if (model.vessel.ventricle.spheres.empty() && !in_artery && (p - root_shift - marks.p_annulus).norm() < 0.06)
      s.irritation = std::max(s.irritation, std::clamp(beyond_valve_m(marks, p - root_shift) / irritates_m, 0.0, 1.0));
    if (is_thin_wire(model.tools[t].instrument) && in_artery) s.wire_cell = f.cell;
  }
}

}  // namespace

CouplingState make_coupling(const Vessel& vessel) {
  CouplingState state;
  if (vessel.coronaries) state.shaft_m.assign(vessel.coronaries->tree().cells.size(), 0);
  return state;
}

CouplingScratch::CouplingScratch(const Vessel& vessel) : locator(vessel.coronaries->map, vessel.coronaries->tree()) {
  points.reserve(1000);
}

vascular::Line line_of(const data::Instrument& guide) {
  vascular::Line line;
  line.bore_m = guide.inner_diameter_m / 2, line.length_m = guide.length_m;
  line.dead_m3 = manifold_m3 + std::numbers::pi * line.bore_m * line.bore_m * line.length_m;
  return line;
}

Vector3d direction_at_tip(const core::Rod& rod, const core::RodState& s) {
  return (s.position[rod.elements] - s.position[rod.elements - 2]).normalized();
}

double marker_from_tip_m(const data::Instrument& instrument, int which) {
  const std::vector<data::Marker>& m = instrument.markers;
  const double a = m[0].from_tip_m + m[0].length_m / 2, b = m[1].from_tip_m + m[1].length_m / 2;
  return which == 0 ? std::max(a, b) : std::min(a, b);
}

Vector3d point_from_tip(const core::Rod& rod, const core::RodState& s, double from_tip_m) {
  if (from_tip_m >= s.inserted_m) return s.base.p_W;
  const std::vector<double>& from_tip = rod.node_from_tip_m;
  // The first node that is not farther; its number is at least 1.
  const auto at = std::lower_bound(from_tip.begin() + 1, from_tip.end() - 1, from_tip_m, std::greater<>());
  const auto i = static_cast<int>(at - from_tip.begin());
  if (i <= s.first) return s.base.p_W;
  const double length = from_tip[static_cast<std::size_t>(i) - 1] - from_tip[static_cast<std::size_t>(i)];
  const double part = (from_tip_m - from_tip[static_cast<std::size_t>(i)]) / length;
  return s.position[i] + part * (s.position[i - 1] - s.position[i]);
}

namespace {

/// Radius of what lies between its markers: of a folded balloon, its profile.
double radius_between_markers(const data::Instrument& instrument) {
  const double middle_m = (marker_from_tip_m(instrument, 0) + marker_from_tip_m(instrument, 1)) / 2;
  for (const core::Section& section : instrument.sections)
    if (section.from_tip_m <= middle_m && middle_m < section.to_tip_m) return section.radius_m;
  return instrument.outer_diameter_m / 2;
}

}  // namespace

std::vector<int> add_devices(const std::vector<SessionTool>& tools, std::uint64_t seed,
                             vascular::TreatmentModel& model) {
  std::vector<int> balloon_of;
  for (const SessionTool& tool : tools) {
    balloon_of.push_back(-1);
    if (!tool.instrument.balloon) continue;
    const data::CarriedBalloon& carried = *tool.instrument.balloon;
    vascular::BalloonModel balloon =
        make_balloon(carried.compliant ? vascular::Compliance::semi : vascular::Compliance::non, carried.nominal_m,
                     carried.length_m, carried.design);
    balloon.name = tool.instrument.title;
    balloon.nominal_Pa = carried.nominal_Pa, balloon.rated_Pa = carried.rated_Pa;
    balloon.seed = seed + model.balloons.size() + 1;
    // Under a stent it is as small as the makers' own balloons are; without one it is what its shaft shows.
    if (!tool.instrument.stent && !carried.own_folds) {
      const double larger_m = balloon.refolded_m - balloon.folded_m;
      balloon.folded_m = radius_between_markers(tool.instrument);
      balloon.refolded_m = balloon.folded_m + larger_m;
    }
    int on = -1;
    try {
      if (tool.instrument.stent) {
        on = static_cast<int>(model.stents.size());
        const data::CarriedStent& stent = *tool.instrument.stent;
        model.stents.push_back(make_stent(stent.nominal_m, stent.length_m, stent.design));
        check(model.stents.back());
      }
      check(balloon);
    } catch (const std::invalid_argument& error) {
      throw data::LoadError(fmt::format("{} ({}): {}", tool.name, tool.instrument.name, error.what()));
    }
    balloon_of.back() = static_cast<int>(model.balloons.size());
    model.balloons.push_back(balloon), model.stent_on.push_back(on);
  }
  return balloon_of;
}

bool is_empty(const vascular::BalloonModel& model, const vascular::BalloonState& state) {
  double most = 0;
  for (double r : state.radius_m) most = std::max(most, r);
  return state.pressure_Pa < 0.2 * 101325 && most < 1.15 * std::max(model.refolded_m, model.folded_m);
}

void look(const CouplingModel& model, const core::State& rods, const vascular::TreatmentState& treatment,
          const core::StepReport& report, double phase, double breath, CouplingScratch& x, CouplingState& s) {
  x.locator.set_moment(phase, breath);
  const vascular::Landmarks& marks = model.vessel.patient->anatomy.landmarks;
  const vascular::HeartMotion motion(marks);
  const Vector3d root_shift =
      vascular::contraction(phase) * motion.root_displacement() + motion.breath_displacement(marks.p_annulus, breath);
  look_at_shafts(model, rods, x, s);
  look_at_balloon(model, rods, treatment, report, x, s);
  look_at_guide(model, rods, report, phase, breath, root_shift, x, s);
  look_at_crimped_stent(model, rods, treatment, s);
  look_at_edge(model, rods, treatment, x, s);
  look_at_wires(model, rods, root_shift, x, s);
  look_at_valve(model, rods, report, phase, breath, root_shift, s);
}

void press_with_wire(const CouplingModel& model, const core::StepReport& report, double step_s, CouplingState& s) {
  Vector3d now_W_N = Vector3d::Zero();
  for (const core::Touch& touch : report.touches) {
    const auto t = static_cast<std::size_t>(touch.rod);
    if (s.wire_cell < 0 || !is_thin_wire(model.tools[t].instrument)) continue;
    if (model.rods.rods[t].node_from_tip_m[static_cast<std::size_t>(touch.node)] <= tip_m)
      now_W_N += touch.normal_W_N + touch.friction_W_N;
  }
  const double share = 1 - std::exp(-2 * std::numbers::pi * data::wall_force_cut_off_Hz * step_s);
  s.wire_tip_N += share * (now_W_N.norm() - s.wire_tip_N);
  if (s.wire_tip_N < 1e-6) s.wire_tip_N = 0;
}

vascular::TreatmentInputs treatment_inputs(const DeliveryInputs& inputs, const CouplingState& s) {
  vascular::TreatmentInputs out;
  out.balloon = s.balloon;
  out.branch = s.branch;
  out.middle_m = seat_m(s);
  out.gauge_Pa = inputs.gauge_Pa;
  out.drag_N = s.drag_N + s.caught_N;
  out.edge_m = s.edge_m, out.edge_N = s.edge_N;
  out.wire_tip_cell = s.wire_cell;
  out.wire_tip_N = s.wire_tip_N;
  out.shaft_m = s.shaft_m;
  out.doses = {inputs.heparin_U, inputs.nitrate_ug, inputs.adenosine_ug};
  return out;
}

void set_physiology_inputs(const CouplingModel& model, const DeliveryInputs& inputs, const CouplingState& s,
                           vascular::PhysiologyInputs& to) {
  to.contrast.injection_m3_s = s.guide < 0 ? 0 : inputs.injection_m3_s;
  to.contrast.iodine_kg_m3 = inputs.iodine_kg_m3;
  to.contrast.shaft_m = s.filled_m;
  to.contrast.tip = s.tip;
  if (s.guide >= 0) to.contrast.line = line_of(model.tools[static_cast<std::size_t>(s.guide)].instrument);
  to.tip_in_ventricle = s.in_ventricle, to.wire_in_catheter = s.thick_wire;
  to.tip_covered = s.covered;
}

}  // namespace ostium::app
