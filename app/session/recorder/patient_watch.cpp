/// Events of the patient's answer and of what is done about it.
#include <algorithm>

#include "app/session/recorder/event_watch.h"
#include "core/base/units.h"

namespace ostium::app {

using units::mL, units::mm3, units::mmHg;

namespace {

/// As the heart fails, a hole bleeds in systole only: that is one leak, which has not stopped.
constexpr double longest_beat_s = 1.5;
constexpr double low_Pa = 80 * mmHg, low_no_more_Pa = 90 * mmHg;

}  // namespace

void EventWatch::look_at_patient(const SessionModel& model, const SessionState& state, const EventSink& say) {
  const vascular::HeartState& heart = state.blood.heart;
  const double time_s = seconds(model, state), leak_m3_s = vascular::leak_m3_s(state.treatment);
  if (leak_m3_s > visible_leak_m3_s) {
    if (!leaks_ && leaked_) say(data::EventCode::leak_goes_on, -1, leak_m3_s / mL);
    if (!leaks_) leaks_since_s_ = time_s;
    leaks_ = leaked_ = true, leak_seen_s_ = time_s;
  } else if (leaks_ && time_s - leak_seen_s_ > longest_beat_s) {
    say(data::EventCode::leak_stops, -1, leak_seen_s_ - leaks_since_s_);
    leaks_ = false;
  }
  const double systolic = heart.beat.systolic_Pa;
  if (!low_ && systolic < low_Pa) say(data::EventCode::pressure_low, -1, systolic / mmHg), low_ = true;
  if (systolic > low_no_more_Pa) low_ = false;
  const bool pulseless = heart.pulseless_s > 0;
  if (pulseless && !pulseless_) say(data::EventCode::pulse_lost, -1, systolic / mmHg), pulseless_since_s_ = time_s;
  if (!pulseless && pulseless_) say(data::EventCode::pulse_back, -1, time_s - pulseless_since_s_);
  pulseless_ = pulseless;
  if (heart.paced != paced_)
    say(heart.paced ? data::EventCode::pacing_captures : data::EventCode::pacing_ends, -1,
        vascular::rate_1_min(model.physiology.heart, heart));
  paced_ = heart.paced;
  if (heart.rhythm != rhythm_) {
    say(data::EventCode::rhythm_changes, -1, static_cast<double>(heart.rhythm));
    if (heart.rhythm == vascular::Rhythm::asystole) say(data::EventCode::heart_stops, -1, heart.pulseless_s);
  }
  rhythm_ = heart.rhythm;
}

void EventWatch::look_at_clots(const SessionState& state, const EventSink& say) {
  const vascular::ThrombusState& clot = state.treatment.thrombus;
  const vascular::AirState& air = state.blood.air;
  const double embolised = clot.embolised_m3, in_muscle = in_muscle_m3(air);
  if (clot.formed > thrombi_) say(data::EventCode::thrombus_forms, -1, volume_m3(clot) / mm3);
  if (embolised > embolised_m3_ + 0.5 * mm3) {
    say(data::EventCode::thrombus_embolises, -1, (embolised - embolised_m3_) / mm3);
    embolised_m3_ = embolised;
  }
  if (in_muscle > air_m3_ + 0.01 * mL) say(data::EventCode::air_in_artery, -1, in_muscle / mL);
  if (air.line_m3 <= 0 && line_air_m3_ > 0 && in_muscle <= air_m3_)
    say(data::EventCode::air_is_out, -1, line_air_m3_ / mL);
  thrombi_ = clot.formed, air_m3_ = in_muscle, line_air_m3_ = air.line_m3;
}

void EventWatch::look_at_awareness(const SessionState& state, double time_s, const EventSink& say) {
  constexpr double hurts = 2, hurts_no_more = 1;  // of 10
  const vascular::AwarenessState& now = state.blood.awareness;
  if (now.awake && !hurts_ && now.pain >= hurts)
    say(data::EventCode::chest_pain, -1, now.pain), hurts_ = true, hurts_since_s_ = time_s;
  if (hurts_ && now.pain < hurts_no_more)
    say(data::EventCode::pain_is_gone, -1, time_s - hurts_since_s_), hurts_ = false;
  if (awake_ && !now.awake)
    say(data::EventCode::faints, -1, state.blood.heart.circulation.mean_Pa / mmHg), fainted_s_ = time_s;
  if (!awake_ && now.awake) say(data::EventCode::wakes, -1, time_s - fainted_s_);
  awake_ = now.awake;
}

void EventWatch::look_at_care(const SessionModel& model, const SessionInputs& inputs, const SessionState& state,
                              const EventSink& say) {
  const DeliveryInputs& hand = inputs.delivery;
  const double round_mL = state.blood.heart.circulation.pericardium_m3 / mL;
  const bool drains = hand.drain_m3_s > 0, infuses = hand.infusion_m3_s > 0;
  if (drains != drains_) say(drains ? data::EventCode::drain_begins : data::EventCode::drain_ends, -1, round_mL);
  if (infuses && !infuses_) say(data::EventCode::infusion_begins, -1, hand.infusion_m3_s / mL);
  drains_ = drains, infuses_ = infuses;
  if (const bool presses = hand.compressions_1_min > 0; presses != compressed_) {
    if (presses) compressed_since_s_ = seconds(model, state);
    say(presses ? data::EventCode::compressions_begin : data::EventCode::compressions_end, -1,
        presses ? hand.compressions_1_min : seconds(model, state) - compressed_since_s_);
    compressed_ = presses;
  }
  if (const bool draws = hand.aspiration_m3_s > 0; draws != draws_) {
    const double out = state.treatment.thrombus.aspirated_m3;
    if (draws) aspirated_m3_ = out;
    say(draws ? data::EventCode::aspiration_begins : data::EventCode::aspiration_ends, -1,
        draws ? hand.aspiration_m3_s / mL : (out - aspirated_m3_) / mm3);
    draws_ = draws;
  }
  if (hand.shock_J > 0) say(data::EventCode::shock, -1, hand.shock_J);
  if (hand.provoked > 0) say(data::EventCode::provoked, -1, hand.provoked);
  if (hand.drug_dose <= 0 || hand.drug < 0) return;
  say(data::EventCode::drug_given, -1, hand.drug);
  const auto& drugs = model.treatment.drugs.others;
  if (static_cast<std::size_t>(hand.drug) >= drugs.size()) return;
  const auto& effects = drugs[static_cast<std::size_t>(hand.drug)].effects;
  const bool reverses = std::any_of(effects.begin(), effects.end(), [](const vascular::DrugEffect& one) {
    return one.target == vascular::DrugTarget::heparin;
  });
  if (const int inside = (state.coupling.wire_cell >= 0) + (state.coupling.balloons[state.coupling.first].branch >= 0);
      reverses && inside > 0)
    say(data::EventCode::protamine_over_devices, -1, inside);
}

}  // namespace ostium::app
