#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>

#include "data/case.h"
#include "data/catalogue.h"
#include "data/script.h"
#include "data/script_keys.h"
#include "fluoro/views.h"

namespace ostium {

namespace {

namespace fs = std::filesystem;
namespace keys = script_keys;
constexpr double degree = std::numbers::pi / 180;
constexpr const char* stands_for_steps = "script";
constexpr int deepest_script = 8;

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
  switch (kind) {
    case ConditionKind::seconds:
    case ConditionKind::beats:
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

/// Counted from 0; in files from 1.
int read_lesion(const JsonObject& object) {
  if (!object.has("lesion")) return 0;
  const double lesion = object.number("lesion");
  if (lesion != std::floor(lesion) || lesion < 1 || lesion > 100) object.refuse("lesion");
  return static_cast<int>(lesion) - 1;
}

bool read_boolean(const JsonObject& object, const std::string& key) {
  if (object[key].type != JsonValue::Type::boolean) object.refuse(key);
  return object[key].number != 0;
}

int tool_called(const Script& script, const JsonValue& name) {
  std::string known;
  for (std::size_t t = 0; t < script.tools.size(); ++t) {
    if (name.type == JsonValue::Type::text && script.tools[t].name == name.text) return static_cast<int>(t);
    known += (known.empty() ? "" : ", ") + script.tools[t].name;
  }
  name.refuse("one of the script's tools: " + known);
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
    if (!read_boolean(object, found->key)) object.refuse(found->key);
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
    c.if_there = read_boolean(object, "if_there");
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

std::vector<ScriptCondition> read_conditions(const JsonObject& step, const char* key, const Script& script,
                                             const std::vector<int>& tools) {
  std::vector<ScriptCondition> out;
  if (!step.has(key)) return out;
  if (step.list(key).empty()) step.refuse(key);
  for (const JsonValue& value : step.list(key)) out.push_back(read_condition(value, script, tools));
  return out;
}

/// Which keys each action has: what it needs, and what it may have.
struct Needs {
  const char* name;
  std::vector<std::string> needs, may;
};
const std::vector<Needs>& actions() {
  static const std::vector<std::string> ends = {"label", "unless", "timeout_s", "otherwise", "tries"};
  const auto with = [](std::vector<std::string> more) {
    more.insert(more.end(), ends.begin(), ends.end());
    return more;
  };
  static const std::vector<Needs> all = {{"advance", {"tool", "speed_mm_s", "until"}, with({"turn_deg_s"})},
                                         {"withdraw", {"tool", "speed_mm_s", "until"}, with({"turn_deg_s"})},
                                         {"turn", {"tool", "turn_deg_s", "until"}, with({})},
                                         {"wait", {"until"}, with({})},
                                         {"view", {}, {"label", "view", "lao_deg", "cran_deg", "table_mm", "field_mm"}},
                                         {"fluoroscopy", {"on"}, {"label"}},
                                         {"cine", {"on"}, {"label"}},
                                         {"heart rate", {"rate_1_min"}, {"label"}},
                                         {"mark", {"text"}, {"label"}},
                                         {"inject", {"rate_mL_s", "volume_mL"}, with({"iodine_mg_mL", "until"})},
                                         {"inflate", {"gauge_atm", "over_s"}, with({"until"})},
                                         {"deflate", {}, with({"until"})},
                                         {"drug", {}, {"label", "heparin_U", "nitrate_ug", "adenosine_ug"}}};
  return all;
}

void require_keys(const JsonObject& step, const Needs& action) {
  for (const std::string& key : action.needs)
    if (!step.has(key))
      step.value().fail(fmt::format("{}.{} is missing; \"{}\" needs it", step.value().path, key, action.name));
  for (const auto& [key, value] : step.value().members) {
    const auto is = [&, k = &key](const std::vector<std::string>& list) {
      return std::find(list.begin(), list.end(), *k) != list.end();
    };
    if (key != "do" && !is(action.needs) && !is(action.may))
      value.fail(fmt::format("{} has no meaning for \"{}\"", value.path, action.name));
  }
}

void read_view(const JsonObject& object, ScriptStep& step) {
  if (object.has("view")) {
    const auto view = find_view(object.text("view"));
    if (!view) object.refuse("view");
    step.lao_rad = degree * view->lao_deg, step.cran_rad = degree * view->cran_deg;
  }
  const auto angle = [&](const char* key, double most) {
    if (std::fabs(object.number(key)) > most) object.refuse(key);
    return degree * object.number(key);
  };
  if (object.has("lao_deg")) step.lao_rad = angle("lao_deg", 120);
  if (object.has("cran_deg")) step.cran_rad = angle("cran_deg", 55);
  if (object.has("table_mm")) {
    const std::vector<double> mm = object.numbers("table_mm", 3);
    step.table_P = 1e-3 * Eigen::Vector3d(mm[0], mm[1], mm[2]);
  }
  if (object.has("field_mm")) {
    const double mm = object.number("field_mm");
    if (mm != 200 && mm != 160 && mm != 130) object.refuse("field_mm");
    step.field_m = 1e-3 * mm;
  }
}

/// Contrast, inflation device, drugs.
void read_treatment(const JsonObject& object, ScriptStep& step) {
  const auto within = [&](const char* key, double most, double unit, double& to) {
    if (!object.has(key)) return;
    if (object.positive(key) > most) object.refuse(key);
    to = unit * object.number(key);
  };
  within("rate_mL_s", 20, 1e-6, step.rate_m3_s);
  within("volume_mL", 60, 1e-6, step.volume_m3);
  within("over_s", 60, 1, step.over_s);
  within("heparin_U", 20000, 1, step.heparin_U);
  within("nitrate_ug", 1000, 1, step.nitrate_ug);
  within("adenosine_ug", 1000, 1, step.adenosine_ug);
  const auto from_zero = [&](const char* key, double most, double unit, double& to) {
    if (!object.has(key)) return;
    if (object.not_negative(key) > most) object.refuse(key);
    to = unit * object.number(key);
  };
  from_zero("iodine_mg_mL", 400, 1, step.iodine_kg_m3);
  from_zero("gauge_atm", 30, 101325, step.gauge_Pa);
  if (step.action == ScriptAction::drug && step.heparin_U + step.nitrate_ug + step.adenosine_ug == 0)
    object.value().fail(object.value().path + " gives nothing; expected heparin_U, nitrate_ug or adenosine_ug");
}

ScriptStep read_step(const JsonValue& value, const Script& script) {
  const JsonObject object(value, keys::step);
  ScriptStep step;
  step.line = value.line;
  std::vector<std::string> names;
  for (const Needs& action : actions()) names.emplace_back(action.name);
  names.emplace_back(stands_for_steps);
  const std::size_t action = object.choice("do", names);
  assert(action < actions().size());  // such are written out by now
  require_keys(object, actions()[action]);
  step.action = static_cast<ScriptAction>(action);
  if (object.has("label")) step.label = object.text("label");
  if (object.has("tool")) {
    const JsonValue& tool = object["tool"];
    if (tool.type == JsonValue::Type::array) {
      if (tool.items.empty()) object.refuse("tool");
      for (const JsonValue& one : tool.items) step.tools.push_back(tool_called(script, one));
    } else {
      step.tools.push_back(tool_called(script, tool));
    }
  }
  if (object.has("speed_mm_s")) {
    if (object.positive("speed_mm_s") > 500) object.refuse("speed_mm_s");
    step.speed_m_s = 1e-3 * object.number("speed_mm_s") * (step.action == ScriptAction::withdraw ? -1 : 1);
  }
  if (object.has("turn_deg_s")) {
    const double turn = object.number("turn_deg_s");
    if (turn == 0 || !(std::fabs(turn) <= 3600)) object.refuse("turn_deg_s");
    step.turn_rad_s = degree * turn;
  }
  step.until = read_conditions(object, "until", script, step.tools);
  step.unless = read_conditions(object, "unless", script, step.tools);
  if (object.has("timeout_s")) {
    step.timeout_s = object.positive("timeout_s");
    if (step.timeout_s > 3600) object.refuse("timeout_s");
  }
  if (object.has("tries")) {
    const double tries = object.number("tries");
    if (!object.has("otherwise") || tries != std::floor(tries) || tries < 1 || tries > 100) object.refuse("tries");
    step.tries = static_cast<int>(tries);
  }
  read_view(object, step);
  if (object.has("on")) step.on = read_boolean(object, "on");
  if (object.has("rate_1_min")) {
    step.rate_1_min = object.number("rate_1_min");
    if (!(step.rate_1_min >= 40 && step.rate_1_min <= 180)) object.refuse("rate_1_min");
  }
  if (object.has("text")) step.text = object.text("text");
  read_treatment(object, step);
  return step;
}

/// Second time round, when all labels are known.
void read_otherwise(const JsonValue& value, Script& script, ScriptStep& step) {
  const JsonObject object(value, keys::step);
  if (!object.has("otherwise")) return;
  const std::string to = object.text("otherwise");
  if (to == "fail") return;
  if (to == "go on") {
    step.otherwise = ScriptStep::Otherwise::go_on;
    return;
  }
  for (std::size_t s = 0; s < script.steps.size(); ++s)
    if (script.steps[s].label == to) step.jump_to = static_cast<int>(s);
  if (step.jump_to < 0) object.refuse("otherwise");
  step.otherwise = ScriptStep::Otherwise::jump;
}

JsonValue* member(JsonValue& object, const std::string& key) {
  for (auto& [name, value] : object.members)
    if (name == key) return &value;
  return nullptr;
}

bool has_tool(const JsonObject& script, const std::string& name) {
  const std::vector<JsonValue>& tools = script.list("tools");
  return std::any_of(tools.begin(), tools.end(),
                     [&](const JsonValue& tool) { return JsonObject(tool, keys::tool).text("name") == name; });
}

/// What a script that names another says of it, said in that one's own steps: under which labels they stand, with which
/// tools, at which lesion.
void say_in_steps(const JsonObject& step, JsonValue& part) {
  const JsonValue* with = step.value().find("with");
  const auto rename = [&](JsonValue& tool) {
    if (const JsonValue* own = with ? with->find(tool.text) : nullptr) tool.text = own->text;
  };
  for (JsonValue& tool : member(part, "tools")->items)
    if (JsonValue* name = member(tool, "name")) rename(*name);
  for (JsonValue& one : member(part, "steps")->items) {
    if (JsonValue* tool = member(one, "tool")) {
      rename(*tool);
      for (JsonValue& each : tool->items) rename(each);
    }
    for (const char* key : {"label", "otherwise"}) {
      JsonValue* label = step.has("label") ? member(one, key) : nullptr;
      if (label && label->text != "fail" && label->text != "go on")
        label->text = step.text("label") + ": " + label->text;
    }
    for (const char* key : {"until", "unless"}) {
      JsonValue* list = member(one, key);
      if (!list) continue;
      for (JsonValue& condition : list->items) {
        if (JsonValue* of = member(condition, "of")) rename(*of);
        const bool about_one = std::any_of(std::begin(kinds), std::end(kinds), [&](const Kind& kind) {
          return is_about_a_lesion(kind.kind) && condition.find(kind.key);
        });
        if (step.has("lesion") && about_one && !condition.find("lesion"))
          condition.members.emplace_back("lesion", step["lesion"]);
      }
    }
  }
}

/// Puts the steps of other scripts where the file names them; their values keep their own file and line. Returns
/// whether there were such.
bool write_out(JsonValue& file, int depth) {
  const JsonObject root(file, keys::root);
  if (root.text("schema") != "ostium-script/1") root.refuse("schema");
  std::vector<JsonValue> steps;
  bool any = false;
  for (const JsonValue& value : root.list("steps")) {
    const JsonValue* action = value.find("do");
    if (!action || action->text != stands_for_steps) {
      steps.push_back(value);
      continue;
    }
    const JsonObject step(value, keys::step);
    require_keys(step, {stands_for_steps, {"script"}, {"label", "lesion", "with"}});
    if (depth == deepest_script) value.fail(fmt::format("{}: scripts in scripts deeper than {}", value.path, depth));
    any = true;
    JsonValue part = load_json((fs::path(*file.file).parent_path() / (step.text("script") + ".json")).string());
    write_out(part, depth + 1);
    read_lesion(step);
    if (step.has("with") && step["with"].type != JsonValue::Type::object) step.refuse("with");
    if (step.has("with"))
      for (const auto& [theirs, ours] : step["with"].members)
        if (!has_tool(JsonObject(part, keys::root), theirs) || !has_tool(root, ours.text))
          ours.fail(fmt::format("{}: expected a tool of {} and the name of one of this script's", ours.path,
                                step.text("script")));
    say_in_steps(step, part);
    for (const JsonValue& tool : JsonObject(part, keys::root).list("tools"))
      if (const std::string name = JsonObject(tool, keys::tool).text("name"); !has_tool(root, name))
        value.fail(
            fmt::format("{}: {} moves a tool \"{}\", and this script has none", value.path, step.text("script"), name));
    for (JsonValue& one : member(part, "steps")->items) steps.push_back(std::move(one));
  }
  if (any) member(file, "steps")->items = std::move(steps);
  return any;
}

ScriptTool read_tool(const JsonObject& tool) {
  ScriptTool out{tool.text("name"), tool.text("instrument"), tool.value().line, {}, 0, 0, read_lesion(tool)};
  if (tool.has("sizes") != (tool.has("of_reference") || tool.has("of_aorta")))
    tool.value().fail(tool.value().path + " has sizes or what they are measured by; expected both or neither");
  if (tool.has("of_reference") && tool.has("of_aorta")) tool.refuse("of_aorta");
  if (tool.has("lesion") && !tool.has("of_reference")) tool.refuse("lesion");
  if (!tool.has("sizes")) return out;
  const char* measure = tool.has("of_aorta") ? "of_aorta" : "of_reference";
  (tool.has("of_aorta") ? out.of_aorta : out.of_reference) = tool.positive(measure);
  if (std::max(out.of_aorta, out.of_reference) > (tool.has("of_aorta") ? 3 : 1.5)) tool.refuse(measure);
  if (tool.list("sizes").empty()) tool.refuse("sizes");
  for (const JsonValue& size : tool.list("sizes")) {
    if (size.type != JsonValue::Type::text || size.text.empty()) tool.refuse("sizes");
    out.sizes.push_back(size.text);
  }
  return out;
}

Script read(JsonValue file, const std::string& text) {
  const bool has_others = write_out(file, 0);
  const JsonObject root(file, keys::root);
  Script script;
  script.file = *file.file;
  script.source = has_others ? to_json(file) : text;
  script.name = root.text("name");
  if (script.name != fs::path(*file.file).stem().string()) root.refuse("name");
  script.title = root.text("title");
  if (root.has("access")) script.access = static_cast<Access>(root.choice("access", access_names()));
  if (root.list("tools").empty()) root.refuse("tools");
  for (const JsonValue& value : root.list("tools")) {
    const JsonObject tool(value, keys::tool);
    for (const ScriptTool& other : script.tools)
      if (other.name == tool.text("name")) value.fail(value.path + ".name: there is another tool of that name");
    script.tools.push_back(read_tool(tool));
  }
  if (root.has("landmarks"))
    for (const JsonValue& value : root.list("landmarks")) {
      const JsonObject landmark(value, keys::landmark);
      const std::vector<double> mm = landmark.numbers("at_mm", 3);
      script.landmarks.push_back({landmark.text("name"), 1e-3 * Eigen::Vector3d(mm[0], mm[1], mm[2])});
    }
  const std::vector<JsonValue>& steps = root.list("steps");
  if (steps.empty()) root.refuse("steps");
  for (const JsonValue& value : steps) {
    script.steps.push_back(read_step(value, script));
    const std::string& label = script.steps.back().label;
    for (std::size_t s = 0; s + 1 < script.steps.size(); ++s)
      if (!label.empty() && script.steps[s].label == label)
        value.fail(value.path + ".label: there is another step \"" + label + "\"");
  }
  for (std::size_t s = 0; s < steps.size(); ++s) read_otherwise(steps[s], script, script.steps[s]);
  return script;
}

std::string all_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

bool is_about_a_lesion(ConditionKind kind) {
  return kind == ConditionKind::balloon_at || kind == ConditionKind::balloon_within ||
         kind == ConditionKind::flow_below || kind == ConditionKind::stenosis_below ||
         kind == ConditionKind::stent_beyond;
}

std::string ScriptStep::words() const {
  const std::string name = actions()[static_cast<std::size_t>(action)].name;
  return label.empty() ? name : fmt::format("{} ({})", name, label);
}

Script read_script(const std::string& file, const std::string& text) { return read(parse_json(file, text), text); }

Script load_script(const std::string& file) { return read(load_json(file), all_of(file)); }

std::vector<Script> load_scripts() {
  const fs::path folder = fs::path(data_folder()) / "scripts";
  std::vector<Script> scripts;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ".json") scripts.push_back(load_script(entry.path().string()));
  if (scripts.empty())
    throw LoadError(folder.string() + ": has no script; expected a folder with at least one NAME.json");
  std::sort(scripts.begin(), scripts.end(), [](const Script& a, const Script& b) { return a.name < b.name; });
  return scripts;
}

Script find_script(const std::string& name_or_file) {
  const fs::path known = fs::path(data_folder()) / "scripts" / (name_or_file + ".json");
  if (fs::is_regular_file(known)) return load_script(known.string());
  if (name_or_file.ends_with(".json")) return load_script(name_or_file);
  std::string names;
  for (const Script& script : load_scripts()) names += "\n  " + script.name;
  throw LoadError(
      fmt::format("there is no script \"{}\"; expected a file NAME.json or one of:{}", name_or_file, names));
}

void refuse(const ScriptCondition& condition, const std::string& what) {
  throw LoadError(fmt::format("{}:{}: {}", condition.file, condition.line, what));
}

}  // namespace ostium
