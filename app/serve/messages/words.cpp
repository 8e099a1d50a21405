#include "app/serve/messages/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "data/assessment/metrics.h"

namespace ostium::app {

namespace {

template <std::size_t n>
std::string one_of(const char* const (&words)[n], double value) {
  return value >= 0 && value < static_cast<double>(n) ? words[static_cast<std::size_t>(value)] : "";
}

std::string step_words(const ScriptPlan& plan, double value) {
  const auto& steps = plan.script.steps;
  return value >= 0 && value < static_cast<double>(steps.size()) ? steps[static_cast<std::size_t>(value)].words() : "";
}

std::string branch_name(const SessionModel& model, double value) {
  const auto& branches = model.vessel->way->branches();
  return value >= 0 && value < static_cast<double>(branches.size()) ? branches[static_cast<std::size_t>(value)].name
                                                                    : "";
}

std::string drug_name(const SessionModel& model, double value) {
  const auto& drugs = model.treatment.drugs.others;
  return value >= 0 && value < static_cast<double>(drugs.size()) ? drugs[static_cast<std::size_t>(value)].name : "";
}

std::string injury_words(double value) {
  static constexpr const char* dissections[] = {"dissection A", "dissection B", "dissection C",
                                                "dissection D", "dissection E", "dissection F"};
  static constexpr const char* perforations[] = {
      "", "perforation, Ellis I", "perforation, Ellis II", "perforation, Ellis III", "", "perforation, Ellis V"};
  return value < 20 ? one_of(dissections, value - 10) : one_of(perforations, value - 20);
}

/// A value with the unit that the event's definition begins with.
std::string value_words(const data::EventDefinition& definition, double value) {
  const std::string& unit = definition.value;
  const std::string first = unit.substr(0, unit.find_first_of(" ,"));
  if (first == "s") return ", " + data::duration_text(value);
  for (const char* known : {"N", "mm", "mm3", "mL/s", "mL", "U", "ug", "atm", "degrees", "J"})
    if (first == known)
      return std::fabs(value) < 1000 ? fmt::format(", {:.3g} {}", value, first)
                                     : fmt::format(", {:.0f} {}", value, first);
  return "";
}

std::string name_words(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

}  // namespace

std::string words_of(const SessionEvent& event, const SessionModel& model, const ScriptPlan& plan) {
  using data::EventCode;
  static constexpr const char* traces[] = {"normal", "damped", "ventricularised", "that of the ventricle", "absent"};
  static constexpr const char* rhythms[] = {"sinus", "AV block", "ventricular fibrillation", "asystole"};
  const data::EventDefinition* definition = data::definition_of(static_cast<EventCode>(event.code));
  if (!definition) return "";
  std::string what = name_words(definition->name) + value_words(*definition, event.value);
  switch (definition->code) {
    case EventCode::script_step_begins:
      if (plan.script.by_hand) return "";
      return step_words(plan, event.value);
    case EventCode::script_step_done:
    case EventCode::ffr_changes:
    case EventCode::instruction_done:  // ticked in the list of instructions
    case EventCode::step_trouble:
      return "";
    case EventCode::script_step_failed:
      return "script: not done: " + step_words(plan, event.value);
    case EventCode::script_step_timed_out:
      return "script: takes too long: " + step_words(plan, event.value);
    case EventCode::tip_enters:
      what = "enters " + branch_name(model, event.value);
      break;
    case EventCode::trace_changes:
      what = "guide pressure " + one_of(traces, event.value);
      break;
    case EventCode::injury:
      return injury_words(event.value);
    case EventCode::provoked:
      return "provoked: " + one_of(vascular::provocation_names, event.value);
    case EventCode::rhythm_changes:
      return "rhythm: " + one_of(rhythms, event.value);
    case EventCode::drug_given:
      return drug_name(model, event.value) + " given";
    case EventCode::chest_pain:
      return fmt::format("patient: \u201cMy chest hurts.\u201d ({:.0f} of 10)", event.value);
    case EventCode::pain_is_gone:
      return "patient: \u201cThe pain is gone.\u201d";
    case EventCode::faints:
      return fmt::format("the patient no longer answers (mean pressure {:.0f} mmHg)", event.value);
    case EventCode::wakes:
      return "the patient answers again";
    case EventCode::idle_beam:
      return "X-rays for 3 s while no tool moves";
    case EventCode::stent_elsewhere:
      what = "stent left in " + branch_name(model, event.value);
      break;
    default:
      break;
  }
  const auto tool = static_cast<std::size_t>(event.tool);
  return event.tool >= 0 && tool < model.tools.size() ? model.tools[tool].name + ": " + what : what;
}

std::string kind_of(const SessionEvent& event) {
  const data::EventDefinition* definition = data::definition_of(static_cast<data::EventCode>(event.code));
  if (!definition) return "event";
  if (definition->severity == data::Severity::critical) return "critical";
  if (definition->severity == data::Severity::error) return "error";
  if (definition->code == data::EventCode::script_step_begins) return "step";
  if (definition->code == data::EventCode::mark) return "mark";
  if (definition->code == data::EventCode::injury) return "critical";
  return "event";
}

}  // namespace ostium::app
