#include "app/session/signals.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "app/session/outcome.h"
#include "core/rod/introducer.h"
#include "data/metrics.h"
#include "vascular/units.h"

namespace ostium {

namespace {

constexpr const char* of_a_tool[] = {"inserted_mm", "turned_deg",   "tip_x_mm",     "tip_y_mm",
                                     "tip_z_mm",    "tip_branch",   "tip_along_mm", "push_N",
                                     "torque_mNm",  "wall_force_N", "tip_force_N",  "touches"};

/// Of a case.
constexpr const char* of_a_patient[] = {"ecg_II_mV",
                                        "ecg_V2_mV",
                                        "aorta_mmHg",
                                        "guide_mmHg",
                                        "trace",
                                        "ST_mV",
                                        "gauge_atm",
                                        "balloon_atm",
                                        "balloon_mm",
                                        "balloon_ratio",
                                        "waist",
                                        "balloon_from_mm",
                                        "balloon_to_mm",
                                        "contrast_mL",
                                        "iodine_g",
                                        "flow_share",
                                        "act_s",
                                        "lesion_mld_mm",
                                        "segment_mld_mm",
                                        "lesion_reference_mm",
                                        "lesion_length_mm",
                                        "stent_from_mm",
                                        "stent_to_mm",
                                        "stent_area_mm2",
                                        "stent_expansion_percent",
                                        "stent_apposed_percent",
                                        "contrast_ostium",
                                        "contrast_landmark",
                                        "stenosis_worst_percent",
                                        "stent_margin_least_mm",
                                        "wire_hazard"};

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double undiluted_kg_m3 = 350;

/// Where contrast comes into the first lesion's artery: behind its ostium, or where a guide's tip is farther in.
int contrast_enters(const SessionModel& model, const SessionState& state) {
  const Coronaries& c = *model.vessel->coronaries;
  const int tip = state.bedside.tip.where == TipPlace::coronary ? state.bedside.tip.cell : -1;
  const bool farther = tip >= 0 && c.ostium_cell >= 0 && c.landmark_cell >= 0 &&
                       c.tree().is_downstream(tip, c.ostium_cell) && c.tree().is_downstream(c.landmark_cell, tip);
  return farther ? tip : c.ostium_cell;
}

/// The first lesion is the nearest of those that the balloon's artery has.
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

template <class Put>
void put_patient(const SessionModel& model, const SessionState& state, const SessionInputs& inputs, Put&& put) {
  const PhysiologyState& blood = state.blood;
  const auto leads = ecg(blood.heart, inputs.rate_1_min, model.physiology.ischaemia, blood.ischaemia);
  put(leads[static_cast<int>(Lead::II)]), put(leads[static_cast<int>(Lead::V2)]);
  put(pressures(model.physiology.heart, blood.heart).aorta_Pa / mmHg);
  put(state.bedside.guide >= 0 ? blood.line.reading_Pa / mmHg : none);
  put(static_cast<double>(state.bedside.guide >= 0 ? blood.line.trace : Trace::absent));
  put(ST_shift_mV(model.physiology.ischaemia, blood.ischaemia));
  const BedsideState& b = state.bedside;
  const BalloonState& balloon = state.treatment.balloon;
  const BalloonModel* own = b.balloon >= 0 ? &model.treatment.balloons[static_cast<std::size_t>(b.balloon)] : nullptr;
  put(inputs.bedside.gauge_Pa / atm);
  put(own ? balloon.pressure_Pa / atm : 0);
  double widest = 0;
  for (double r : balloon.radius_m) widest = std::max(widest, 2e3 * r);
  put(own ? widest : 0);
  put(balloon_artery_ratio(model, state));
  put(own ? waist(*own, balloon) : none);
  const bool has_lesion = !model.vessel->coronaries->lesions.empty();
  const double length =
      has_lesion ? model.vessel->coronaries->lesions[0].to_m - model.vessel->coronaries->lesions[0].from_m : 0;
  const auto at = has_lesion && is_at_first(model, state) ? balloon_from_lesion_m(model, state) : std::nullopt;
  put(at ? 1e3 * (*at + length / 2 - own->length_m / 2) : none);
  put(at ? 1e3 * (*at + length / 2 + own->length_m / 2) : none);
  put(1e6 * blood.contrast.injected_kg / undiluted_kg_m3);
  put(1e3 * blood.contrast.from_tip_kg);
  put(has_lesion ? supply_behind_lesion(model, state) : none);
  put(act_s(model.treatment.drugs, state.treatment.drugs));
  const LesionNow lesion = has_lesion ? lesion_now(model, state) : LesionNow{none, none, none, none};
  put(1e3 * lesion.mld_m), put(1e3 * lesion.segment_mld_m), put(1e3 * lesion.reference_m), put(1e3 * length);
  const auto stent = has_lesion ? stented(model, state) : std::nullopt;
  put(stent ? 1e3 * stent->from_m : none), put(stent ? 1e3 * stent->to_m : none);
  const auto open = has_lesion ? stent_now(model, state) : std::nullopt;
  put(open ? 1e6 * open->minimal_area_m2 : none);
  put(open ? 100 * open->expansion : none), put(open ? 100 * open->apposed : none);
  for (int cell : {contrast_enters(model, state), model.vessel->coronaries->landmark_cell}) {
    if (cell < 0) {
      put(none);
      continue;
    }
    const double r = blood.radius_m[static_cast<std::size_t>(cell)];
    put(concentration(blood.contrast, model.physiology.flow, cell, std::numbers::pi * r * r) / undiluted_kg_m3);
  }
  const WorstOfLesions worst = has_lesion ? worst_of_lesions(model, state) : WorstOfLesions{none, {}};
  put(100 * worst.stenosis), put(worst.margin_m ? 1e3 * *worst.margin_m : none);
  put(state.treatment.injury.wire_H);
}

}  // namespace

std::size_t signal_count(const SessionModel& model) {
  return 2 + (model.has_patient() ? std::size(of_a_patient) : 0) + model.tools.size() * std::size(of_a_tool) +
         (model.breaths_1_min > 0 ? 1 : 0);
}

std::vector<std::string> signal_names(const SessionModel& model) {
  std::vector<std::string> names = {"time_s", "heart_phase"};
  if (model.has_patient()) names.insert(names.end(), std::begin(of_a_patient), std::end(of_a_patient));
  for (const SessionTool& tool : model.tools)
    for (const char* name : of_a_tool) names.push_back(tool.name + "." + name);
  if (model.breaths_1_min > 0) names.push_back("breath_depth");
  return names;
}

void put_signals(const SessionModel& model, const SessionState& state, const SessionInputs& inputs,
                 const SessionReport& report, float* row) {
  const auto put = [&](double number) { *row++ = static_cast<float>(number); };
  put(seconds(model, state));
  put(state.blood.heart.phase);
  if (model.has_patient()) put_patient(model, state, inputs, put);
  for (int t = 0; t < static_cast<int>(model.tools.size()); ++t) {
    const auto i = static_cast<std::size_t>(t);
    const ToolReport& tool = report.tools[i];
    const Eigen::Vector3d p = tip(model, state, t);
    const Way& way = *model.vessel->way;
    const int sphere = tool.in_body ? way.locate(p, state.blood.heart.phase, breath(model, state)) : -1;
    put(1e3 * state.rods.rods[i].inserted_m);
    put(180 / EIGEN_PI * state.hands[i].turned_rad);
    for (int axis = 0; axis < 3; ++axis) put(1e3 * p[axis]);
    put(sphere < 0 ? -1 : way.branch(sphere));
    put(sphere < 0 ? 0 : 1e3 * way.from_access_m(sphere));
    put(tool.push_N);
    put(1e3 * tool.torque_Nm);
    put(tool.wall_force_N);
    put(tool.tip_force_N);
    put(tool.touches);
  }
  if (model.breaths_1_min > 0) put(breath(model, state));
}

EventWatch::EventWatch(const SessionModel& model)
    : tools_(model.tools.size()), handling_(model), stents_(model.treatment.stents.size(), StentState::on_balloon) {}

void EventWatch::look_at_patient(const SessionModel& model, const SessionInputs& inputs, const SessionState& state,
                                 const SessionReport& report, const EventSink& say) {
  const BedsideInputs& hand = inputs.bedside;
  const TreatmentState& treated = state.treatment;
  const double time_s = seconds(model, state);
  const Trace trace = state.bedside.guide >= 0 ? state.blood.line.trace : Trace::absent;
  const bool injects = hand.injection_m3_s > 0, inflated = hand.gauge_Pa > atm && state.bedside.balloon >= 0;
  if (injects && !injects_) {
    say(EventCode::injection_begins, -1, 1e6 * hand.injection_m3_s);
    if (trace_ == Trace::damped || trace_ == Trace::ventricularised)
      say(EventCode::injection_on_bad_trace, -1, static_cast<double>(trace_));
  }
  if (!injects && injects_)
    say(EventCode::injection_ends, -1, 1e6 * state.blood.contrast.injected_kg / undiluted_kg_m3);
  injects_ = injects;
  if (hand.heparin_U > 0) say(EventCode::heparin, -1, hand.heparin_U);
  if (hand.nitrate_ug > 0) say(EventCode::nitrate, -1, hand.nitrate_ug);
  if (hand.adenosine_ug > 0) say(EventCode::adenosine, -1, hand.adenosine_ug);
  // While contrast or a thick wire is in the guide there is no trace to judge.
  if (trace != trace_) say(EventCode::trace_changes, -1, static_cast<double>(trace));
  trace_ = trace;
  if (state.blood.heart.ectopic > ectopic_) say(EventCode::extrasystole, -1, 0);
  ectopic_ = state.blood.heart.ectopic;
  if (inflated && !inflated_) {
    say(EventCode::inflation_begins, -1, 0);
    inflated_since_s_ = time_s, filled_ = true;
    if (state.bedside.branch < 0) say(EventCode::inflation_in_catheter, -1, 0);
  }
  inflated_ = inflated;
  if (state.bedside.balloon >= 0) {
    const BalloonModel& own = model.treatment.balloons[static_cast<std::size_t>(state.bedside.balloon)];
    const bool over = hand.gauge_Pa > own.rated_Pa;
    if (over && !over_) say(EventCode::over_pressure, -1, hand.gauge_Pa / atm);
    over_ = over;
    if (filled_ && !inflated && is_empty(own, treated.balloon))
      say(EventCode::deflated, -1, time_s - inflated_since_s_), filled_ = false;
    if (treated.balloon.burst > burst_) say(EventCode::balloon_burst, -1, hand.gauge_Pa / atm);
  }
  burst_ = treated.balloon.burst;
  for (std::size_t i = 0; i < treated.stents.size(); ++i) {
    const StentState::Where where = treated.stents[i].where;
    if (where == stents_[i]) continue;
    const StentState& own = treated.stents[i];
    const auto at = model.vessel->coronaries->lesions.empty() ? std::nullopt
                                                              : stent_from_lesion_m(model, state, static_cast<int>(i));
    if (where != StentState::deployed || own.branch < 0)
      say(EventCode::stent_lost, -1, 0);
    else if (at)
      say(EventCode::stent_deployed, -1, 1e3 * *at);
    else
      say(EventCode::stent_elsewhere, -1,
          model.physiology.flow.tree.branches[static_cast<std::size_t>(own.branch)].tree_branch);
    stents_[i] = where;
  }
  if (!model.vessel->coronaries->lesions.empty() && state.rods.step % look_every == 0) {
    const bool closed = supply_behind_lesion(model, state) < occluded_share;
    if (closed && !closed_) say(EventCode::occlusion_begins, -1, 0), closed_since_s_ = time_s;
    if (!closed && closed_) say(EventCode::occlusion_ends, -1, time_s - closed_since_s_);
    closed_ = closed;
  }
  for (std::size_t i = 0; i < treated.injury.injuries.size(); ++i) {
    const Injury& injury = treated.injury.injuries[i];
    const double value = injury.cell < 0 ? 0 : 10 * static_cast<int>(injury.kind) + injury.grade;
    if (value > injuries_[i]) say(EventCode::injury, -1, value);
    injuries_[i] = value;
  }
  if (report.refused >= 0 && refused_ != report.refused)
    say(EventCode::entry_refused, report.refused, report.in_its_way);
  refused_ = report.refused;
}

void EventWatch::look(const SessionModel& model, const SessionInputs& inputs, const SessionState& state,
                      const SessionReport& report, const std::vector<OperatorEvent>& script,
                      std::vector<SessionEvent>& events) {
  const std::uint64_t now = state.rods.step;
  const EventSink say{now, events};
  for (const OperatorEvent& e : script) {
    using Kind = OperatorEvent::Kind;
    say(e.kind == Kind::begins   ? EventCode::script_step_begins
        : e.kind == Kind::done   ? EventCode::script_step_done
        : e.kind == Kind::failed ? EventCode::script_step_failed
        : e.kind == Kind::marked ? EventCode::mark
                                 : EventCode::script_step_timed_out,
        -1, e.step);
  }
  const bool looks = now % HandlingWatch::every == 0;
  if (looks) handling_.look(model, inputs, state, report, say);
  for (int t = 0; t < static_cast<int>(tools_.size()); ++t) {
    Tool& before = tools_[static_cast<std::size_t>(t)];
    const ToolReport& tool = report.tools[static_cast<std::size_t>(t)];
    if (tool.in_body != before.in_body) say(tool.in_body ? EventCode::tool_in : EventCode::tool_out, t, 0);
    before.in_body = tool.in_body;
    before.wall_force_N += (1 - std::exp(-2 * EIGEN_PI * wall_force_cut_off_Hz * model.step_s())) *
                           (tool.wall_force_N - before.wall_force_N);
    const bool pressed = before.wall_force_N > (before.pressed ? 0.8 : 1) * wall_force_limit_N;
    if (pressed && !before.pressed) say(EventCode::wall_force_high, t, before.wall_force_N);
    before.pressed = pressed;
    if (!looks) continue;
    const int sphere = handling_.scene().tools[static_cast<std::size_t>(t)].sphere;
    const int branch = tool.in_body ? model.vessel->way->branch(sphere) : -1;
    if (before.branch.comes_to(branch, now, model.step_s())) say(EventCode::tip_enters, t, branch);
  }
  const CArmInputs& arm = inputs.c_arm;
  if (arm.fluoroscopy != fluoroscopy_)
    say(arm.fluoroscopy ? EventCode::fluoroscopy_on : EventCode::fluoroscopy_off, -1, 0);
  if (arm.cine != cine_) say(arm.cine ? EventCode::cine_on : EventCode::cine_off, -1, 0);
  fluoroscopy_ = arm.fluoroscopy, cine_ = arm.cine;
  const std::uint32_t trouble = report.rods.trouble & ~static_cast<std::uint32_t>(feed_stopped | drive_limited);
  if (trouble && !trouble_) say(EventCode::step_trouble, -1, trouble);
  trouble_ = trouble;
  if (model.has_patient()) look_at_patient(model, inputs, state, report, say);
}

}  // namespace ostium
