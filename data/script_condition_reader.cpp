#include "data/script_condition_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "data/script_keys.h"

namespace ostium {

namespace {

namespace keys = script_keys;
constexpr double degree = std::numbers::pi / 180;

/// A condition's kinds, and what brings their value to SI; 0: they have none.
struct Kind {
  const char* key;
  ConditionKind kind;
  double unit;
};
constexpr Kind kinds[] = {{"tip_passes", ConditionKind::tip_passes, 0},
                          {"tip_leaves", ConditionKind::tip_leaves, 0},
                          {"tip_in", ConditionKind::tip_in, 0},
                          {"tip_on", ConditionKind::tip_on, 0},
                          {"tip_astray", ConditionKind::tip_astray, 0},
                          {"tip_points", ConditionKind::tip_points, 0},
                          {"tip_faces", ConditionKind::tip_faces, 0},
                          {"tip_drops_mm", ConditionKind::tip_drops, 1e-3},
                          {"fed_mm", ConditionKind::fed, 1e-3},
                          {"inserted_mm", ConditionKind::inserted, 1e-3},
                          {"out", ConditionKind::out, 0},
                          {"turned_deg", ConditionKind::turned, degree},
                          {"hub_within_deg", ConditionKind::hub_within, degree},
                          {"push_exceeds_N", ConditionKind::push_exceeds, 1},
                          {"torque_exceeds_mNm", ConditionKind::torque_exceeds, 1e-3},
                          {"wall_force_exceeds_N", ConditionKind::wall_force_exceeds, 1},
                          {"tip_force_exceeds_N", ConditionKind::tip_force_exceeds, 1},
                          {"seconds", ConditionKind::seconds, 1},
                          {"beats", ConditionKind::beats, 1},
                          {"balloon_at_mm", ConditionKind::balloon_at, 1e-3},
                          {"balloon_within_mm", ConditionKind::balloon_within, 1e-3},
                          {"balloon_clear_of_guide_mm", ConditionKind::balloon_clear, 1e-3},
                          {"balloon_open", ConditionKind::balloon_open, 0},
                          {"balloon_empty", ConditionKind::balloon_empty, 0},
                          {"engaged", ConditionKind::engaged, 0},
                          {"trace", ConditionKind::trace, 0},
                          {"contrast_in", ConditionKind::contrast_in, 0},
                          {"flow_below_percent", ConditionKind::flow_below, 1e-2},
                          {"ST_exceeds_mV", ConditionKind::ST_exceeds, 1e-3},
                          {"act_exceeds_s", ConditionKind::act_exceeds, 1},
                          {"stenosis_below_percent", ConditionKind::stenosis_below, 1e-2},
                          {"stent_beyond_mm", ConditionKind::stent_beyond, 1e-3},
                          {"unharmed", ConditionKind::unharmed, 0}};

/// What is not seen of one tool.
bool of_no_tool(ConditionKind kind) {
  return kind == ConditionKind::seconds || kind == ConditionKind::beats || needs_patient(kind);
}

ScriptCondition read_condition(const JsonValue& value, const Script& script, const std::vector<int>& tools) {
  const JsonObject object(value, keys::condition);
  ScriptCondition c;
  c.file = *value.file;
  c.line = value.line;
  const Kind* found = nullptr;
  for (const Kind& kind : kinds) {
    if (!object.has(kind.key)) continue;
    if (found) value.fail(fmt::format("{} has both {} and {}; expected one of them", value.path, found->key, kind.key));
    found = &kind;
  }
  if (!found) value.fail(value.path + " says nothing to look at; expected one of tip_passes, fed_mm, seconds, ...");
  c.kind = found->kind;
  if (object.has("of"))
    c.tool = tool_called(script, object["of"]);
  else if (!tools.empty())
    c.tool = tools.front();
  else if (!of_no_tool(c.kind) && script.tools.size() > 1)
    value.fail(value.path + " does not say of which tool; expected \"of\"");
  if (found->unit > 0) {
    const bool may_be_zero = c.kind == ConditionKind::inserted, any = c.kind == ConditionKind::balloon_at;
    c.value = found->unit * (any           ? object.number(found->key)
                             : may_be_zero ? object.not_negative(found->key)
                                           : object.positive(found->key));
    c.words = fmt::format("{} {:g}", found->key, object.number(found->key));
  } else if (c.kind == ConditionKind::out || c.kind == ConditionKind::balloon_open ||
             c.kind == ConditionKind::balloon_empty || c.kind == ConditionKind::unharmed) {
    if (!object.boolean(found->key)) object.refuse(found->key);
    c.words = found->key;
  } else if (c.kind == ConditionKind::trace) {
    const std::vector<std::string> names = {"normal", "damped", "ventricularised", "ventricle", "absent"};
    c.place = names[object.choice("trace", names)];
    c.words = "trace " + c.place;
  } else if (c.kind == ConditionKind::tip_points) {
    const std::vector<std::string> names = {"left", "right", "head", "feet", "front", "back"};
    const std::size_t n = object.choice("tip_points", names);
    c.direction_P[static_cast<Eigen::Index>(n / 2)] = n % 2 ? -1 : 1;
    c.words = "tip_points " + names[n];
  } else {
    c.place = object.text(found->key);
    c.words = fmt::format("{} {}", found->key, c.place);
  }
  if (object.has("if_there")) {
    if (c.kind != ConditionKind::tip_in && c.kind != ConditionKind::tip_leaves && c.kind != ConditionKind::tip_passes)
      object.refuse("if_there");
    c.if_there = object.boolean("if_there");
  }
  const bool of_angle = c.kind == ConditionKind::tip_points || c.kind == ConditionKind::tip_faces;
  if (of_angle) {
    if (!object.has("within_deg"))
      value.fail(value.path + ".within_deg is missing; expected how exactly, in degrees, > 0 and at most 90");
    c.value = degree * object.positive("within_deg");
  }
  if (c.kind == ConditionKind::tip_astray) {
    if (!object.has("by_mm"))
      value.fail(value.path + ".by_mm is missing; expected how far from the line of that branch, in mm, > 0");
    c.value = 1e-3 * object.positive("by_mm");
  } else if (object.has("by_mm")) {
    object.refuse("by_mm");
  }
  if (object.has("lesion") && !is_about_a_lesion(c.kind)) object.refuse("lesion");
  c.lesion = read_lesion(object);
  if (c.lesion > 0) c.words += fmt::format(" of lesion {}", c.lesion + 1);
  if (object.has("within_deg") && (!of_angle || object.number("within_deg") > 90)) object.refuse("within_deg");
  if (tools.empty() ? object.has("of") : c.tool != tools.front()) c.words += " of " + script.tools[c.tool].name;
  return c;
}

}  // namespace

bool needs_patient(ConditionKind kind) {
  switch (kind) {
    case ConditionKind::balloon_at:
    case ConditionKind::balloon_within:
    case ConditionKind::balloon_clear:
    case ConditionKind::balloon_open:
    case ConditionKind::balloon_empty:
    case ConditionKind::engaged:
    case ConditionKind::trace:
    case ConditionKind::contrast_in:
    case ConditionKind::flow_below:
    case ConditionKind::ST_exceeds:
    case ConditionKind::act_exceeds:
    case ConditionKind::stenosis_below:
    case ConditionKind::stent_beyond:
    case ConditionKind::unharmed:
      return true;
    default:
      return false;
  }
}

bool is_about_a_lesion(ConditionKind kind) {
  return kind == ConditionKind::balloon_at || kind == ConditionKind::balloon_within ||
         kind == ConditionKind::flow_below || kind == ConditionKind::stenosis_below ||
         kind == ConditionKind::stent_beyond;
}

/// Counted from 0; in files from 1.
int read_lesion(const JsonObject& object) {
  if (!object.has("lesion")) return 0;
  const double lesion = object.number("lesion");
  if (lesion != std::floor(lesion) || lesion < 1 || lesion > 100) object.refuse("lesion");
  return static_cast<int>(lesion) - 1;
}

int tool_called(const Script& script, const JsonValue& name) {
  std::string known;
  for (std::size_t t = 0; t < script.tools.size(); ++t) {
    if (name.type == JsonValue::Type::text && script.tools[t].name == name.text) return static_cast<int>(t);
    known += (known.empty() ? "" : ", ") + script.tools[t].name;
  }
  name.refuse("one of the script's tools: " + known);
}

std::vector<ScriptCondition> read_conditions(const JsonObject& step, const char* key, const Script& script,
                                             const std::vector<int>& tools) {
  std::vector<ScriptCondition> out;
  if (!step.has(key)) return out;
  if (step.list(key).empty()) step.refuse(key);
  for (const JsonValue& value : step.list(key)) out.push_back(read_condition(value, script, tools));
  return out;
}

bool has_condition_about_a_lesion(const JsonValue& condition) {
  return std::any_of(std::begin(kinds), std::end(kinds),
                     [&](const Kind& kind) { return is_about_a_lesion(kind.kind) && condition.find(kind.key); });
}

}  // namespace ostium
