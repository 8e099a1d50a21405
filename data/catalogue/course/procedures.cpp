/// Every case with the procedure that ships for it.
#include <fmt/format.h>

#include <algorithm>

#include "core/base/units.h"
#include "data/catalogue/case/case.h"
#include "data/catalogue/course/course.h"

namespace ostium::data {

namespace {

const char* const ways[] = {"pci-", "provisional-"};  // of procedures, before the name of the case that they are for

std::string joined_tools(const ScriptStep& step, const Script& script) {
  std::string out;
  for (const int t : step.tools) out += (out.empty() ? "" : " and ") + script.tools[static_cast<std::size_t>(t)].name;
  return out;
}

bool leaves_body(const ScriptStep& step) {
  return std::ranges::any_of(step.until, [](const ScriptCondition& c) { return c.kind == ConditionKind::out; });
}

/// Whether the expert goes past it where it is not needed: an earlier step that fails leads on behind it.
bool is_optional(const Script& script, std::size_t s) {
  const ScriptStep& step = script.steps[s];
  if (step.detour || step.otherwise == ScriptStep::Otherwise::go_on) return true;
  for (std::size_t before = 0; before < s; ++before)
    if (script.steps[before].jump_to > static_cast<int>(s)) return true;
  return false;
}

/// Whether it brings a tool to a place, and not only on by a length.
bool leads_to_a_place(const Script& script, std::size_t s) {
  const ScriptStep& step = script.steps[s];
  return step.action == ScriptAction::advance && !step.label.empty() && !step.until.empty() &&
         !is_optional(script, s) &&
         std::ranges::none_of(step.until, [](const ScriptCondition& c) { return c.kind == ConditionKind::fed; });
}

/// Whether a person has to do it, too, and it is not on the way to the tool's next place.
bool is_milestone(const Script& script, std::size_t s) {
  using enum ScriptAction;
  const ScriptStep& step = script.steps[s];
  if (step.label.empty() || is_optional(script, s)) return false;
  if (step.action == withdraw) return leaves_body(step);
  if (step.action == drug) return step.heparin_U > 0 || step.nitrate_ug > 0;
  if (step.action == inflate) return true;
  if (!leads_to_a_place(script, s)) return false;
  for (std::size_t next = s + 1; next < script.steps.size(); ++next) {
    const ScriptStep& later = script.steps[next];
    if (later.action != advance || later.tools != step.tools) {
      if (is_optional(script, next) || later.action == turn) continue;
      return true;
    }
    if (leads_to_a_place(script, next)) return false;
  }
  return true;
}

/// A label without the tool's name, which is said before it.
std::string without(const std::string& tool, const std::string& label) {
  if (!label.starts_with(tool)) return label;
  const std::size_t rest = label.find_first_not_of(" ,", tool.size());
  return rest == std::string::npos || rest == tool.size() ? label : label.substr(rest);
}

Instruction instruction_of(const Script& script, std::size_t s, bool first) {
  using enum ScriptAction;
  const ScriptStep& step = script.steps[s];
  Instruction out;
  out.expert_step = static_cast<int>(s), out.in_turn = !first, out.line = step.line;
  const std::string tools = joined_tools(step, script);
  if (step.action == drug) {
    out.event = step.heparin_U > 0 ? "heparin" : "nitrate";
    out.text = fmt::format("Give {}.", out.event);
  } else if (step.action == inflate) {
    out.event = "inflation_begins";
    out.text = fmt::format("Fill the {}, {:.0f} atm: {}.", tools.empty() ? "balloon" : tools,
                           step.gauge_Pa / units::atm, step.label);
  } else {
    out.until = step.until;
    out.text = step.action == withdraw ? fmt::format("Draw the {} out.", tools)
                                       : fmt::format("Bring the {} on: {}.", tools, without(tools, step.label));
  }
  return out;
}

std::string words_of(const Case& c) {
  std::string out = fmt::format("{} ECG: {} Planned: {}.", c.card.history, c.card.ecg, c.card.planned_access);
  for (const vascular::Lesion& lesion : c.lesions)
    out += fmt::format(" {}: {:.0f} % over {:.0f} mm{}{}.", lesion.branch, 100 * lesion.stenosis,
                       lesion.length_m / units::mm, lesion.eccentric ? ", eccentric" : "",
                       lesion.made_of.calcified() ? ", calcified" : "");
  return out;
}

}  // namespace

Course procedures_course(std::optional<std::uint64_t> person, const std::vector<std::string>& set) {
  Course course;
  course.name = "procedures", course.title = "Procedures", course.in_order = false;
  course.file = "ostium play";
  course.note =
      "Every case that ships, with the instruments of its procedure. The list of steps is how the expert does it; "
      "other "
      "ways are as good where the narrowing is open in the end.";
  const std::vector<Script> scripts = load_scripts();
  for (const Case& c : load_cases())
    for (const char* way : ways) {
      const auto script = std::ranges::find(scripts, way + c.name, &Script::name);
      if (script == scripts.end()) continue;
      Lesson lesson;
      lesson.name = person ? fmt::format("{}-person-{}", c.name, *person) : c.name;
      lesson.title = c.title + (c.anatomy.access == vascular::Access::radial ? ", from the wrist" : ", from the groin");
      if (person) lesson.title += fmt::format(" (person {})", *person);
      lesson.goal = words_of(c);
      lesson.case_name = c.name, lesson.script = script->name, lesson.scoring = "pci-elective";
      lesson.person = person, lesson.set = set;
      lesson.must_hold = {"2", "31", "32", "33", "34"};
      for (std::size_t s = 0; s < script->steps.size(); ++s)
        if (is_milestone(*script, s))
          lesson.instructions.push_back(instruction_of(*script, s, lesson.instructions.empty()));
      course.lessons.push_back(std::move(lesson));
      break;
    }
  return course;
}

}  // namespace ostium::data
