#include "app/serve/messages/hints.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/units.h"

namespace ostium::app {

namespace {

using data::ConditionKind;
using data::ScriptAction;
using units::degree;

/// "RCA+20": 20 mm down the right coronary; "D1-4": 4 mm before the D1.
std::string place_words(const std::string& place) {
  const auto sign = place.find_first_of("+-");
  std::string branch = place.substr(0, sign);
  for (const auto& [code, name] :
       {std::pair{"RCA", "right coronary"}, {"LM", "left main"}, {"sinuses", "pockets above the valve"}})
    if (branch == code) branch = name;
  const std::string where = "the " + branch;
  if (sign == std::string::npos) return where;
  return place.substr(sign + 1) + (place[sign] == '+' ? " mm down " : " mm before ") + where;
}

/// What holds, as the end of "until ...".
std::string until_words(const data::Script& script, const data::ScriptCondition& c) {
  const std::string tool = "the " + script.tools[static_cast<std::size_t>(c.tool)].name;
  const double mm = 1e3 * c.value, deg = c.value / degree;
  switch (c.kind) {
    case ConditionKind::tip_passes:
      return fmt::format("the tip of {} has come to {}", tool, place_words(c.place));
    case ConditionKind::tip_in:
    case ConditionKind::tip_on:
      return fmt::format("the tip of {} lies in {}", tool, place_words(c.place));
    case ConditionKind::tip_leaves:
      return fmt::format("the tip of {} is back before {}", tool, place_words(c.place));
    case ConditionKind::tip_faces:
      return fmt::format("the tip of {} points to the mouth of {}", tool, place_words(c.place));
    case ConditionKind::fed:
      return fmt::format("{} has moved by {:.3g} mm", tool, mm);
    case ConditionKind::inserted:
      return fmt::format("{:.3g} cm of {} are in", mm / 10, tool);
    case ConditionKind::out:
      return tool + " is out";
    case ConditionKind::turned:
      return fmt::format("{} is turned by {:.3g}°", tool, deg);
    case ConditionKind::push_exceeds:
      return "the hand feels that it pushes against something";
    case ConditionKind::tip_force_exceeds:
      return fmt::format("the tip of {} meets something", tool);
    case ConditionKind::seconds:
      return fmt::format("{:.3g} s have passed", c.value);
    case ConditionKind::beats:
      return fmt::format("{:.3g} heartbeats have passed", c.value);
    case ConditionKind::balloon_at:
      return std::fabs(mm) < 1 ? "the middle between its two marks lies in the middle of the narrowing"
                               : fmt::format("the middle between its two marks is {:.3g} mm {} the narrowing's middle",
                                             std::fabs(mm), mm < 0 ? "short of" : "beyond");
    case ConditionKind::balloon_within:
      return "the middle between its two marks lies in the middle of the narrowing";
    case ConditionKind::balloon_spans:
      return mm > 0   ? fmt::format("its two marks lie {:.3g} mm beyond the narrowing on both sides", mm)
             : mm < 0 ? "its two marks lie at both ends of the narrowing"
                      : "its two marks lie on both sides of the narrowing";
    case ConditionKind::balloon_clear:
      return "the balloon is clear of the guide's tip";
    case ConditionKind::balloon_open:
      return "the balloon is open all along";
    case ConditionKind::balloon_empty:
      return "the balloon is empty";
    case ConditionKind::engaged:
      return "the guide's tip lies in the mouth of " + place_words(c.place);
    case ConditionKind::stenosis_below:
      return fmt::format("less than {:.3g} % of the narrowing is left", 100 * c.value);
    case ConditionKind::stent_beyond:
      return fmt::format("the stent covers the narrowing and {:.3g} mm on both sides", mm);
    case ConditionKind::unharmed:
      return "it is sure that the artery is whole";
    default: {
      std::string words = c.words;
      std::replace(words.begin(), words.end(), '_', ' ');
      return words;
    }
  }
}

std::string tools_words(const data::Script& script, const data::ScriptStep& step) {
  std::string out;
  for (const int tool : step.tools)
    out += (out.empty() ? "the " : " and the ") + script.tools[static_cast<std::size_t>(tool)].name;
  return out;
}

std::string done_words(const data::Script& script, const data::ScriptStep& step) {
  const std::string tools = tools_words(script, step);
  const std::string turn = fmt::format("{:.3g}° a second {}", std::fabs(step.turn_rad_s) / degree,
                                       step.turn_rad_s < 0 ? "counterclockwise" : "clockwise");
  const std::string moved = fmt::format(", {:.3g} mm a second{}", 1e3 * std::fabs(step.feed_m_s),
                                        step.turn_rad_s == 0 ? "" : ", turning by " + turn);
  switch (step.action) {
    case ScriptAction::advance:
      return "pushes " + tools + " in" + moved;
    case ScriptAction::withdraw:
      return "draws " + tools + " back" + moved;
    case ScriptAction::turn:
      return "turns " + tools + ", " + turn;
    case ScriptAction::wait:
      return "waits";
    case ScriptAction::inject:
      return fmt::format("injects {:.3g} mL of contrast, {:.3g} mL a second", 1e6 * step.volume_m3,
                         1e6 * step.rate_m3_s);
    case ScriptAction::inflate:
      return fmt::format("fills the balloon to {:.3g} atm within {:.3g} s", step.gauge_Pa / units::atm, step.over_s);
    case ScriptAction::deflate:
      return "empties the balloon by vacuum";
    case ScriptAction::drug:
      return step.heparin_U > 0    ? fmt::format("gives {:.4g} units of heparin", step.heparin_U)
             : step.nitrate_ug > 0 ? "gives nitrate"
                                   : "gives adenosine";
    case ScriptAction::fluoroscopy:
      return step.on ? "steps on the X-ray pedal" : "lets go of the X-ray pedal";
    case ScriptAction::cine:
      return step.on ? "steps on the film pedal" : "lets go of the film pedal";
    case ScriptAction::view:
      return "moves the C-arm or the table";
    default:
      return "goes on with \"" + step.label + "\"";
  }
}

/// What the expert does before another try of a step that begins anew further back.
std::string again_words(const data::Script& script, int from, int failed) {
  std::string words, last;
  for (int i = from; i < failed; ++i) {
    const data::ScriptStep& step = script.steps[static_cast<std::size_t>(i)];
    std::string one = done_words(script, step);
    if (step.turn_rad_s == 0) one = one.substr(0, one.find(','));  // how fast matters less than which way
    if (one != last) words += (words.empty() ? "" : "; ") + one;
    last = std::move(one);
  }
  return "Where that fails, the expert " + words + "; and tries again.";
}

}  // namespace

std::string hint_of(const data::Script& script, const data::ScriptStep& step) {
  std::string until;
  for (const data::ScriptCondition& c : step.until)
    until += (until.empty() ? ", until " : ", or ") + until_words(script, c);
  return "The expert " + done_words(script, step) + until + ".";
}

std::vector<std::string> hints_of(const data::Script& script, int from, int end, std::size_t most) {
  std::vector<std::string> out;
  const int last = end < 0 ? static_cast<int>(script.steps.size()) : end;
  for (int i = from; i >= 0 && i < last && out.size() < most; ++i) {
    const data::ScriptStep& step = script.steps[static_cast<std::size_t>(i)];
    if (step.label.empty() || step.detour) continue;
    out.push_back(hint_of(script, step));
    if (step.otherwise == data::ScriptStep::Otherwise::jump && step.jump_to < i && out.size() < most)
      out.push_back(again_words(script, step.jump_to, i));
  }
  return out;
}

}  // namespace ostium::app
