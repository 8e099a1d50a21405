#include "app/session/recorder/event_watch.h"

#include <cmath>

#include "app/session/model/outcome.h"
#include "core/base/units.h"
#include "core/rod/introducer.h"

namespace ostium::app {

namespace {

using units::atm;

}  // namespace

data::EventCode event_code(OperatorEvent::Kind kind) {
  using Kind = OperatorEvent::Kind;
  return kind == Kind::begins       ? data::EventCode::script_step_begins
         : kind == Kind::done       ? data::EventCode::script_step_done
         : kind == Kind::failed     ? data::EventCode::script_step_failed
         : kind == Kind::marked     ? data::EventCode::mark
         : kind == Kind::instructed ? data::EventCode::instruction_done
         : kind == Kind::hinted     ? data::EventCode::hint_asked
                                    : data::EventCode::script_step_timed_out;
}

EventWatch::EventWatch(const SessionModel& model)
    : tools_(model.tools.size()),
      handling_(model),
      stents_(model.treatment.stents.size(), vascular::StentState::on_balloon) {}

void EventWatch::look_at_syringe(const SessionInputs& inputs, const SessionState& state, const EventSink& say) {
  const DeliveryInputs& hand = inputs.delivery;
  const bool injects = hand.injection_m3_s > 0;
  if (injects && !injects_) {
    say(data::EventCode::injection_begins, -1, 1e6 * hand.injection_m3_s);
    if (trace_ == vascular::Trace::damped || trace_ == vascular::Trace::ventricularised)
      say(data::EventCode::injection_on_bad_trace, -1, static_cast<double>(trace_));
  }
  if (!injects && injects_)
    say(data::EventCode::injection_ends, -1, 1e6 * state.blood.contrast.injected_kg / undiluted_kg_m3);
  injects_ = injects;
  if (hand.heparin_U > 0) say(data::EventCode::heparin, -1, hand.heparin_U);
  if (hand.nitrate_ug > 0) say(data::EventCode::nitrate, -1, hand.nitrate_ug);
  if (hand.adenosine_ug > 0) say(data::EventCode::adenosine, -1, hand.adenosine_ug);
}

void EventWatch::look_at_heart(const SessionState& state, const EventSink& say) {
  // With contrast or a thick wire in the guide there is no pressure trace to classify.
  const vascular::Trace trace = state.coupling.guide >= 0 ? state.blood.line.trace : vascular::Trace::absent;
  if (trace != trace_) say(data::EventCode::trace_changes, -1, static_cast<double>(trace));
  trace_ = trace;
  if (state.blood.heart.ectopic > ectopic_) say(data::EventCode::extrasystole, -1, 0);
  ectopic_ = state.blood.heart.ectopic;
}

void EventWatch::look_at_balloon(const SessionModel& model, const SessionInputs& inputs, const SessionState& state,
                                 const EventSink& say) {
  const double time_s = seconds(model, state);
  for (int k = 0; k < vascular::most_balloons; ++k) {
    const CoupledBalloon& place = state.coupling.balloons[k];
    const vascular::BalloonState& balloon = state.treatment.balloons[k];
    WatchedBalloon& was = balloons_[k];
    const double gauge_Pa = k == state.coupling.first ? inputs.delivery.gauge_Pa : inputs.delivery.second_gauge_Pa;
    const bool inflated = gauge_Pa > atm && place.balloon >= 0;
    if (inflated && !was.inflated) {
      say(data::EventCode::inflation_begins, -1, 0);
      was.inflated_since_s = time_s, was.filled = true;
      if (place.branch < 0) say(data::EventCode::inflation_in_catheter, -1, 0);
    }
    was.inflated = inflated;
    if (place.balloon >= 0) {
      const vascular::BalloonModel& own = model.treatment.balloons[static_cast<std::size_t>(place.balloon)];
      const bool over = gauge_Pa > own.rated_Pa;
      if (over && !was.over) say(data::EventCode::over_pressure, -1, gauge_Pa / atm);
      was.over = over;
      if (was.filled && !inflated && is_empty(own, balloon))
        say(data::EventCode::deflated, -1, time_s - was.inflated_since_s), was.filled = false;
      if (balloon.burst > was.burst) say(data::EventCode::balloon_burst, -1, gauge_Pa / atm);
    }
    was.burst = balloon.burst;
  }
}

void EventWatch::look_at_stents(const SessionModel& model, const SessionState& state, const EventSink& say) {
  for (std::size_t i = 0; i < state.treatment.stents.size(); ++i) {
    const vascular::StentState& own = state.treatment.stents[i];
    const vascular::StentState::Where where = own.where;
    if (where == stents_[i]) continue;
    std::optional<double> at;  // from the first lesion in whose artery it lies
    for (int lesion = 0; !at && lesion < static_cast<int>(model.vessel->coronaries->lesions.size()); ++lesion)
      at = stent_from_lesion_m(model, state, static_cast<int>(i), lesion);
    if (where != vascular::StentState::deployed || own.branch < 0)
      say(data::EventCode::stent_lost, -1, 0);
    else if (at)
      say(data::EventCode::stent_deployed, -1, 1e3 * *at);
    else
      say(data::EventCode::stent_elsewhere, -1,
          model.physiology.flow.tree.branches[static_cast<std::size_t>(own.branch)].tree_branch);
    stents_[i] = where;
    if (model.treatment.stents[i].covered && where == vascular::StentState::deployed)
      say(data::EventCode::covered_stent, -1, perforated_s_ < 0 ? -1 : seconds(model, state) - perforated_s_);
  }
}

void EventWatch::look_at_flow(const SessionModel& model, const SessionState& state, const EventSink& say) {
  if (model.vessel->coronaries->lesions.empty() || state.rods.step % look_every != 0) return;
  const double time_s = seconds(model, state);
  const bool closed = supply_behind_lesion(model, state) < data::occluded_share;
  if (closed && !closed_) say(data::EventCode::occlusion_begins, -1, 0), closed_since_s_ = time_s;
  if (!closed && closed_) say(data::EventCode::occlusion_ends, -1, time_s - closed_since_s_);
  closed_ = closed;
}

void EventWatch::look_at_injuries(const SessionState& state, double time_s, const EventSink& say) {
  const auto& injuries = state.treatment.injury.injuries;
  for (std::size_t i = 0; i < injuries.size(); ++i) {
    const double value = injuries[i].cell < 0 ? 0 : 10 * static_cast<int>(injuries[i].kind) + injuries[i].grade;
    if (value > injuries_[i]) {
      if (injuries[i].kind == vascular::InjuryKind::perforation) perforated_s_ = time_s;
      say(data::EventCode::injury, -1, value);
      if (injuries[i].kind == vascular::InjuryKind::perforation)
        say(data::EventCode::perforation, -1, injuries[i].grade);
    }
    injuries_[i] = value;
  }
}

void EventWatch::look_at_entry(const SessionReport& report, const EventSink& say) {
  if (report.refused >= 0 && refused_ != report.refused)
    say(data::EventCode::entry_refused, report.refused, report.in_its_way);
  refused_ = report.refused;
}

void EventWatch::look_at_tools(const SessionModel& model, const SessionReport& report, std::uint64_t now,
                               bool handling_looked, const EventSink& say) {
  for (int t = 0; t < static_cast<int>(tools_.size()); ++t) {
    Tool& before = tools_[static_cast<std::size_t>(t)];
    const ToolReport& tool = report.tools[static_cast<std::size_t>(t)];
    if (tool.in_body != before.in_body) say(tool.in_body ? data::EventCode::tool_in : data::EventCode::tool_out, t, 0);
    before.in_body = tool.in_body;
    before.wall_force_N += (1 - std::exp(-2 * units::pi * data::wall_force_cut_off_Hz * model.step_s())) *
                           (tool.wall_force_N - before.wall_force_N);
    if (before.wall_force_N > data::wall_force_limit_N && !before.pressed) {
      say(data::EventCode::wall_force_high, t, before.wall_force_N);
      before.pressed = true;
    }
    before.eased_s = before.wall_force_N > 0.8 * data::wall_force_limit_N ? 0 : before.eased_s + model.step_s();
    if (before.eased_s > data::wall_force_over_s) before.pressed = false;
    if (!handling_looked) continue;
    const int branch = tool.in_body ? handling_.scene().tools[static_cast<std::size_t>(t)].branch : -1;
    if (before.branch.comes_to(branch, now, model.step_s())) say(data::EventCode::tip_enters, t, branch);
  }
}

void EventWatch::look_at_beam(const CArmInputs& arm, const EventSink& say) {
  if (arm.fluoroscopy != fluoroscopy_)
    say(arm.fluoroscopy ? data::EventCode::fluoroscopy_on : data::EventCode::fluoroscopy_off, -1, 0);
  if (arm.cine != cine_) say(arm.cine ? data::EventCode::cine_on : data::EventCode::cine_off, -1, 0);
  fluoroscopy_ = arm.fluoroscopy, cine_ = arm.cine;
}

void EventWatch::look(const SessionModel& model, const SessionInputs& inputs, const SessionState& state,
                      const SessionReport& report, const std::vector<OperatorEvent>& script,
                      std::vector<SessionEvent>& events) {
  const std::uint64_t now = state.rods.step;
  const EventSink say{now, events};
  for (const OperatorEvent& e : script) say(event_code(e.kind), -1, e.step);
  const bool looks = now % HandlingWatch::every == 0;
  if (looks) handling_.look(model, inputs, state, report, say);
  look_at_tools(model, report, now, looks, say);
  look_at_beam(inputs.c_arm, say);
  const std::uint32_t trouble =
      report.rods.trouble & ~static_cast<std::uint32_t>(core::feed_stopped | core::drive_limited);
  if (trouble && !trouble_) say(data::EventCode::step_trouble, -1, trouble);
  trouble_ = trouble;
  if (!model.has_patient()) return;
  look_at_syringe(inputs, state, say);  // uses the previous trace
  look_at_heart(state, say);
  look_at_balloon(model, inputs, state, say);
  look_at_stents(model, state, say);
  look_at_flow(model, state, say);
  look_at_injuries(state, seconds(model, state), say);
  look_at_entry(report, say);
  look_at_patient(model, state, say);
  look_at_clots(state, say);
  look_at_awareness(state, seconds(model, state), say);
  look_at_care(model, inputs, state, say);
}

}  // namespace ostium::app
