#include "app/session/recorder/signals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "app/session/model/outcome.h"
#include "core/base/units.h"
#include "core/rod/introducer.h"

namespace ostium::app {

namespace {

using units::atm, units::mmHg;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// A row of a table of signals; `Now` holds what the values are computed from.
template <class Now>
struct Signal {
  const char *name, *unit, *definition;
  double (*of)(const Now&);
};

/// The current state of the run.
struct RunNow {
  const SessionModel& model;
  const SessionState& state;
  const SessionInputs& inputs;
};

constexpr Signal<RunNow> of_the_run[] = {
    {"time_s", "s", "simulated time", [](const RunNow& x) { return seconds(x.model, x.state); }},
    {"heart_phase", "1", "share of the cycle since the R wave",
     [](const RunNow& x) { return x.state.blood.heart.phase; }},
};

constexpr Signal<RunNow> of_the_breath[] = {
    {"breath_depth", "1", "0 breathed out, 1 breathed in", [](const RunNow& x) { return breath(x.model, x.state); }},
};

/// The cell where contrast enters the first lesion's artery: beyond its ostium, or at a guide's tip deeper in.
int contrast_enters(const SessionModel& model, const SessionState& state) {
  const Coronaries& c = *model.vessel->coronaries;
  const int tip = state.coupling.tip.where == vascular::TipPlace::coronary ? state.coupling.tip.cell : -1;
  const bool farther = tip >= 0 && c.ostium_cell >= 0 && c.landmark_cell >= 0 &&
                       c.tree().is_downstream(tip, c.ostium_cell) && c.tree().is_downstream(c.landmark_cell, tip);
  return farther ? tip : c.ostium_cell;
}

/// Whether the first lesion is the nearest of those in the balloon's artery.
bool is_at_first(const SessionModel& model, const SessionState& state) {
  const auto from_m = [&](int lesion) {
    const auto at = balloon_from_lesion_m(model, state, lesion);
    return at ? std::fabs(*at) : std::numeric_limits<double>::infinity();
  };
  const double first_m = from_m(0);
  for (int i = 1; i < static_cast<int>(model.vessel->coronaries->lesions.size()); ++i)
    if (from_m(i) < first_m) return false;
  return std::isfinite(first_m);
}

/// The current state of a patient, shared by several signals.
struct PatientNow {
  PatientNow(const SessionModel& own_model, const SessionState& own_state, const SessionInputs& own_inputs);
  double contrast_at(int cell) const;        ///< relative to undiluted; NaN: no such cell
  double balloon_end_mm(double side) const;  ///< from the lesion's proximal end; side -1: proximal, 1: distal
  bool has_guide() const { return state.coupling.guide >= 0; }

  const SessionModel& model;
  const SessionState& state;
  const SessionInputs& inputs;
  const vascular::PhysiologyState& blood;
  std::array<double, vascular::leads> ecg_mV;
  BalloonInBody own_balloon, second;                ///< the first and the second in the body
  const vascular::BalloonModel* balloon = nullptr;  ///< of the first
  bool has_lesion;
  double lesion_length_m = 0;
  std::optional<double> balloon_from_middle_m;  ///< from the first lesion's middle, while no other lesion is nearer
  LesionNow lesion{none, none, none, none};
  std::optional<Stretch> stents;
  std::optional<StentNow> open;
  WorstOfLesions worst{none, {}};
};

PatientNow::PatientNow(const SessionModel& own_model, const SessionState& own_state, const SessionInputs& own_inputs)
    : model(own_model),
      state(own_state),
      inputs(own_inputs),
      blood(state.blood),
      ecg_mV(ecg(model.physiology.heart, blood.heart, model.physiology.ischaemia, blood.ischaemia)),
      own_balloon(balloon_in_body(state.coupling, state.treatment, inputs.delivery, 0)),
      second(balloon_in_body(state.coupling, state.treatment, inputs.delivery, 1)),
      has_lesion(!model.vessel->coronaries->lesions.empty()) {
  if (own_balloon) balloon = &model.treatment.balloons[static_cast<std::size_t>(own_balloon.place->balloon)];
  if (!has_lesion) return;
  const Plan& plan = model.vessel->coronaries->lesions[0];
  lesion_length_m = plan.to_m - plan.from_m;
  if (is_at_first(model, state))
    balloon_from_middle_m = balloon_from_lesion_m(model, state, 0, own_balloon ? own_balloon.place->tool : -1);
  lesion = lesion_now(model, state);
  stents = stented(model, state);
  open = stent_now(model, state);
  worst = worst_of_lesions(model, state);
}

double PatientNow::contrast_at(int cell) const {
  if (cell < 0) return none;
  const double r = blood.radius_m[static_cast<std::size_t>(cell)];
  return concentration(blood.contrast, model.physiology.flow, cell, units::pi * r * r) / undiluted_kg_m3;
}

double PatientNow::balloon_end_mm(double side) const {
  if (!balloon_from_middle_m) return none;
  return 1e3 * (*balloon_from_middle_m + lesion_length_m / 2 + side * (balloon->length_m / 2));
}

double widest_mm(const BalloonInBody& balloon) {
  if (!balloon) return 0;
  return 2e3 * *std::max_element(balloon.state->radius_m.begin(), balloon.state->radius_m.end());
}

double most_aside_mm(const PatientNow& x) {
  double most = 0;
  if (x.own_balloon)
    for (const Eigen::Vector2d& aside_m : x.own_balloon.state->aside_m) most = std::max(most, 1e3 * aside_m.norm());
  return most;
}

/// "The lesion" is the first of the case; positions along its artery are measured from its proximal end.
constexpr Signal<PatientNow> of_a_patient[] = {
    {"ecg_II_mV", "mV", "lead II",
     [](const PatientNow& x) -> double { return x.ecg_mV[static_cast<int>(vascular::Lead::II)]; }},
    {"ecg_V2_mV", "mV", "lead V2",
     [](const PatientNow& x) -> double { return x.ecg_mV[static_cast<int>(vascular::Lead::V2)]; }},
    {"aorta_mmHg", "mmHg", "pressure in the aorta",
     [](const PatientNow& x) { return pressures(x.model.physiology.heart, x.blood.heart).aorta_Pa / mmHg; }},
    {"guide_mmHg", "mmHg", "pressure that the guide's line reads",
     [](const PatientNow& x) { return x.has_guide() ? x.blood.line.reading_Pa / mmHg : none; }},
    {"trace", "1", "0 normal, 1 damped, 2 ventricularised, 3 ventricle, 4 absent",
     [](const PatientNow& x) {
       return x.has_guide() ? static_cast<double>(x.blood.line.trace) : static_cast<double>(vascular::Trace::absent);
     }},
    {"ST_mV", "mV", "largest ST shift in a lead",
     [](const PatientNow& x) { return ST_shift_mV(x.model.physiology.ischaemia, x.blood.ischaemia); }},
    {"gauge_atm", "atm", "of the inflation device",
     [](const PatientNow& x) { return x.inputs.delivery.gauge_Pa / atm; }},
    {"balloon_atm", "atm", "pressure in the balloon",
     [](const PatientNow& x) { return x.own_balloon ? x.own_balloon.state->pressure_Pa / atm : 0; }},
    {"balloon_mm", "mm", "its largest diameter", [](const PatientNow& x) { return widest_mm(x.own_balloon); }},
    {"second_gauge_atm", "atm", "of the second inflation device",
     [](const PatientNow& x) { return x.inputs.delivery.second_gauge_Pa / atm; }},
    {"second_balloon_atm", "atm", "pressure in the second balloon in the body",
     [](const PatientNow& x) { return x.second ? x.second.state->pressure_Pa / atm : 0; }},
    {"second_balloon_mm", "mm", "its largest diameter", [](const PatientNow& x) { return widest_mm(x.second); }},
    {"balloon_ratio", "1", "its largest diameter between its markers over the healthy artery's there",
     [](const PatientNow& x) { return balloon_artery_ratio(x.model, x.state); }},
    {"waist", "1", "narrowest over widest of the balloon between its markers",
     [](const PatientNow& x) { return x.balloon ? waist(*x.balloon, *x.own_balloon.state) : none; }},
    {"balloon_aside_mm", "mm", "most that its middle line lies aside of the artery's, once it is filled",
     most_aside_mm},
    {"balloon_slid_mm", "mm", "how far it lies off its place on its shaft, along the artery, distally",
     [](const PatientNow& x) {
       return x.own_balloon ? 1e3 * (x.own_balloon.state->seat_m - x.own_balloon.place->middle_m) : none;
     }},
    {"balloon_from_mm", "mm", "its proximal end, while no other lesion is nearer",
     [](const PatientNow& x) { return x.balloon_end_mm(-1); }},
    {"balloon_to_mm", "mm", "its distal end", [](const PatientNow& x) { return x.balloon_end_mm(1); }},
    {"contrast_mL", "mL", "out of the syringe since the run began, undiluted",
     [](const PatientNow& x) { return 1e6 * x.blood.contrast.injected_kg / undiluted_kg_m3; }},
    {"iodine_g", "g", "that left the catheter", [](const PatientNow& x) { return 1e3 * x.blood.contrast.from_tip_kg; }},
    {"flow_share", "1", "flow behind the lesion over what the muscle needs",
     [](const PatientNow& x) { return x.has_lesion ? supply_behind_lesion(x.model, x.state) : none; }},
    {"act_s", "s", "activated clotting time",
     [](const PatientNow& x) { return act_s(x.model.treatment.drugs, x.state.treatment.drugs); }},
    {"lesion_mld_mm", "mm", "smallest diameter within the lesion",
     [](const PatientNow& x) { return 1e3 * x.lesion.mld_m; }},
    {"segment_mld_mm", "mm", "the same with 5 mm on both sides of lesion and stents",
     [](const PatientNow& x) { return 1e3 * x.lesion.segment_mld_m; }},
    {"lesion_reference_mm", "mm", "diameter of the healthy artery about it",
     [](const PatientNow& x) { return 1e3 * x.lesion.reference_m; }},
    {"lesion_length_mm", "mm", "of the lesion", [](const PatientNow& x) { return 1e3 * x.lesion_length_m; }},
    {"stent_from_mm", "mm", "proximal end of the stents at the lesion",
     [](const PatientNow& x) { return x.stents ? 1e3 * x.stents->from_m : none; }},
    {"stent_to_mm", "mm", "their distal end",
     [](const PatientNow& x) { return x.stents ? 1e3 * x.stents->to_m : none; }},
    {"stent_area_mm2", "mm2", "smallest area inside them",
     [](const PatientNow& x) { return x.open ? 1e6 * x.open->minimal_area_m2 : none; }},
    {"stent_expansion_percent", "%", "that over the area of the reference diameter",
     [](const PatientNow& x) { return x.open ? 100 * x.open->expansion : none; }},
    {"stent_apposed_percent", "%", "share of their struts' points that lie on the wall",
     [](const PatientNow& x) { return x.open ? 100 * x.open->apposed : none; }},
    {"contrast_ostium", "1", "concentration over the undiluted where contrast comes into the lesion's artery",
     [](const PatientNow& x) { return x.contrast_at(contrast_enters(x.model, x.state)); }},
    {"contrast_landmark", "1", "the same at the landmark of TIMI frame counts",
     [](const PatientNow& x) { return x.contrast_at(x.model.vessel->coronaries->landmark_cell); }},
    {"stenosis_worst_percent", "%", "of the case's lesions, that of which most is left",
     [](const PatientNow& x) { return 100 * x.worst.stenosis; }},
    {"stent_margin_least_mm", "mm", "least that stents reach beyond a lesion; not a number: one has none",
     [](const PatientNow& x) { return x.worst.margin_m ? 1e3 * *x.worst.margin_m : none; }},
    {"systolic_mmHg", "mmHg", "highest pressure in the aorta in the last beat",
     [](const PatientNow& x) { return x.blood.heart.beat.systolic_Pa / mmHg; }},
    {"heart_rate_1_min", "1/min", "of the ventricles, by the last beat",
     [](const PatientNow& x) { return 60 / x.blood.heart.cycle_s; }},
    {"output_L_min", "L/min", "stroke volume of the last beat times that",
     [](const PatientNow& x) { return 60e3 * x.blood.heart.beat.stroke_m3 / x.blood.heart.cycle_s; }},
    {"pericardium_mL", "mL", "fluid round the heart",
     [](const PatientNow& x) { return x.blood.heart.circulation.pericardium_m3 / units::mL; }},
    {"pericardium_mmHg", "mmHg", "pressure in the pericardium",
     [](const PatientNow& x) { return x.blood.heart.circulation.pericardium_Pa / mmHg; }},
    {"leak_mL_s", "mL/s", "out of the arteries, through all holes",
     [](const PatientNow& x) { return leak_m3_s(x.state.treatment) / units::mL; }},
    {"thrombus_mm3", "mm3", "in the coronary arteries",
     [](const PatientNow& x) { return volume_m3(x.state.treatment.thrombus) / units::mm3; }},
    {"air_mL", "mL", "in the arterioles of the heart's muscle",
     [](const PatientNow& x) { return in_muscle_m3(x.blood.air) / units::mL; }},
    {"pain", "1", "of the patient's chest, 0 to 10", [](const PatientNow& x) { return x.blood.awareness.pain; }},
    {"awake", "1", "1 or 0", [](const PatientNow& x) { return x.blood.awareness.awake ? 1.0 : 0.0; }},
    {"rhythm", "1", "0 sinus, 1 AV block, 2 VF, 3 asystole",
     [](const PatientNow& x) { return static_cast<double>(x.blood.heart.rhythm); }},
    {"wire_hazard", "1", "hazard so far that the wire's tip perforates",
     [](const PatientNow& x) -> double { return x.state.treatment.injury.wire_H; }},
};

/// The current state of a tool.
struct ToolNow {
  ToolNow(const SessionModel& model, const SessionState& state, const SessionReport& own, int t)
      : rod(state.rods.rods[static_cast<std::size_t>(t)]),
        hand(state.hands[static_cast<std::size_t>(t)]),
        report(own.tools[static_cast<std::size_t>(t)]),
        way(*model.vessel->way),
        tip_m(tip(model, state, t)),
        sphere(report.in_body ? way.locate(tip_m, state.blood.heart.phase, breath(model, state)) : -1) {}

  const core::RodState& rod;
  const HandState& hand;
  const ToolReport& report;
  const VesselIndex& way;
  Eigen::Vector3d tip_m;
  int sphere;  ///< of the vessel index, at the tip; -1: outside the body
};

/// How far the wall that instruments meet lies aside, at most.
double most_aside_m(const RunNow& x) {
  double most = 0;
  for (const Eigen::Vector3d& aside : x.state.wall_aside_P) most = std::max(most, aside.norm());
  return most;
}

/// Of arteries that give way.
constexpr Signal<RunNow> of_the_bed[] = {
    {"artery_aside_mm", "mm", "how far instruments push or straighten an artery aside, at most",
     [](const RunNow& x) { return 1e3 * most_aside_m(x); }},
};

constexpr Signal<ToolNow> of_a_tool[] = {
    {"inserted_mm", "mm", "length in the body", [](const ToolNow& x) -> double { return 1e3 * x.rod.inserted_m; }},
    {"turned_deg", "degrees", "at the hub",
     [](const ToolNow& x) -> double { return 180 / units::pi * x.hand.turned_rad; }},
    {"tip_x_mm", "mm", "of the tip, to the patient's left", [](const ToolNow& x) { return 1e3 * x.tip_m.x(); }},
    {"tip_y_mm", "mm", "of the tip, to the head", [](const ToolNow& x) { return 1e3 * x.tip_m.y(); }},
    {"tip_z_mm", "mm", "of the tip, to the front", [](const ToolNow& x) { return 1e3 * x.tip_m.z(); }},
    {"tip_branch", "1", "branch of the vessel's tree, from 0; -1: out of the body",
     [](const ToolNow& x) { return x.sphere < 0 ? -1.0 : x.way.branch(x.sphere); }},
    {"tip_along_mm", "mm", "the tip's way from the access along the tree",
     [](const ToolNow& x) { return x.sphere < 0 ? 0 : 1e3 * x.way.from_access_m(x.sphere); }},
    {"push_N", "N", "force of the hand, negative: it pulls", [](const ToolNow& x) { return x.report.push_N; }},
    {"torque_mNm", "mN m", "torque of the hand", [](const ToolNow& x) { return 1e3 * x.report.torque_Nm; }},
    {"wall_force_N", "N", "sum of the walls' normal forces", [](const ToolNow& x) { return x.report.wall_force_N; }},
    {"tip_force_N", "N", "the same, of the last 10 mm", [](const ToolNow& x) { return x.report.tip_force_N; }},
    {"touches", "1", "places where it touches a wall", [](const ToolNow& x) -> double { return x.report.touches; }},
};

template <class Now, std::size_t n>
void put(const Signal<Now> (&table)[n], const Now& now, float*& row) {
  for (const Signal<Now>& signal : table) *row++ = static_cast<float>(signal.of(now));
}

}  // namespace

std::vector<SignalDefinition> signal_definitions(const SessionModel& model) {
  std::vector<SignalDefinition> out;
  const auto add = [&](const auto& table, const std::string& prefix = "") {
    for (const auto& signal : table) out.push_back({prefix + signal.name, signal.unit, signal.definition});
  };
  add(of_the_run);
  if (model.has_patient()) add(of_a_patient);
  for (const SessionTool& tool : model.tools) add(of_a_tool, tool.name + ".");
  if (model.breaths_1_min > 0) add(of_the_breath);
  if (model.bed) add(of_the_bed);
  return out;
}

std::size_t signal_count(const SessionModel& model) {
  return std::size(of_the_run) + (model.has_patient() ? std::size(of_a_patient) : 0) +
         model.tools.size() * std::size(of_a_tool) + (model.breaths_1_min > 0 ? std::size(of_the_breath) : 0) +
         (model.bed ? std::size(of_the_bed) : 0);
}

std::vector<std::string> signal_names(const SessionModel& model) {
  std::vector<std::string> names;
  for (SignalDefinition& signal : signal_definitions(model)) names.push_back(std::move(signal.name));
  return names;
}

void put_signals(const SessionModel& model, const SessionState& state, const SessionInputs& inputs,
                 const SessionReport& report, float* row) {
  const RunNow run{model, state, inputs};
  put(of_the_run, run, row);
  if (model.has_patient()) put(of_a_patient, PatientNow(model, state, inputs), row);
  for (int t = 0; t < static_cast<int>(model.tools.size()); ++t) put(of_a_tool, ToolNow(model, state, report, t), row);
  if (model.breaths_1_min > 0) put(of_the_breath, run, row);
  if (model.bed) put(of_the_bed, run, row);
}

}  // namespace ostium::app
