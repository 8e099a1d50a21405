#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <filesystem>
#include <iterator>

#include "core/base/units.h"
#include "data/catalogue/case/case.h"
#include "data/catalogue/catalogue.h"
#include "data/catalogue/script/script.h"
#include "data/catalogue/script/script_actions.h"
#include "data/catalogue/script/script_condition_reader.h"
#include "data/catalogue/script/script_keys.h"
#include "data/catalogue/script/script_parts.h"
#include "data/formats/paths.h"
#include "data/formats/read_file.h"
#include "fluoro/projection/views.h"

namespace ostium::data {

namespace {

namespace fs = std::filesystem;
using units::degree;

void read_view(const JsonObject& object, ScriptStep& step) {
  const bool angles = object.has("lao_deg") || object.has("cran_deg");
  if (object.has("view") && angles)
    object.value().fail(object.value().path() + " says two views; expected view, or lao_deg and cran_deg");
  if (step.action == ScriptAction::view && !object.has("view") && !angles && !object.has("table_mm") &&
      !object.has("field_mm"))
    object.value().fail(object.value().path() +
                        " moves nothing; expected view, lao_deg and cran_deg, table_mm or field_mm");
  if (object.has("view")) {
    const auto view = fluoro::find_view(object.text("view"));
    if (!view) object.refuse("view");
    step.lao_rad = degree * view->lao_deg, step.cran_rad = degree * view->cran_deg;
  }
  if (object.has("lao_deg")) step.lao_rad = degree * object.number("lao_deg");
  if (object.has("cran_deg")) step.cran_rad = degree * object.number("cran_deg");
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
  const auto number = [&](const char* key, double unit, double& to) {
    if (object.has(key)) to = unit * object.number(key);
  };
  number("rate_mL_s", 1e-6, step.rate_m3_s);
  number("volume_mL", 1e-6, step.volume_m3);
  number("over_s", 1, step.over_s);
  number("heparin_U", 1, step.heparin_U);
  number("nitrate_ug", 1, step.nitrate_ug);
  number("adenosine_ug", 1, step.adenosine_ug);
  number("dose_ug", 1, step.dose);
  number("dose_mg", 1, step.dose);
  number("energy_J", 1, step.energy_J);
  number("current_mA", 1, step.current_mA);
  number("iodine_mg_mL", 1, step.iodine_kg_m3);
  number("gauge_atm", 101325, step.gauge_Pa);
  if (step.action == ScriptAction::drug && step.heparin_U + step.nitrate_ug + step.adenosine_ug == 0)
    object.value().fail(object.value().path() + " gives nothing; expected heparin_U, nitrate_ug or adenosine_ug");
}

/// What of a complication is asked for beside its name and place.
void read_complication(const JsonObject& object, ScriptStep& step) {
  using vascular::Provoked;
  if (object.has("at")) step.at = object.text("at");
  const auto kind = static_cast<Provoked>(1 + object.choice("complication", script_keys::complication_names()));
  step.complication = static_cast<int>(kind);
  const bool nowhere =
      kind == Provoked::fibrillation || kind == Provoked::block || kind == Provoked::air || kind == Provoked::vagal;
  if (nowhere == object.has("at"))
    object.value().fail(object.value().path() +
                        (nowhere ? " has a place; rhythms and reactions have none, and air is in the line"
                                 : ".at is missing; expected a place in a coronary artery"));
  const auto only_of = [&](const char* key, bool own) {
    if (object.has(key) && !own)
      object[key].fail(fmt::format("{} has no meaning for {}", object[key].path(), object.text("complication")));
    return object.has(key);
  };
  step.size = kind == Provoked::perforation  ? 0.8e-3
              : kind == Provoked::dissection ? 2
              : kind == Provoked::thrombus   ? 25e-9
              : kind == Provoked::air        ? 0.5e-6
              : kind == Provoked::vagal      ? 0.8
                                             : 0.9;
  if (only_of("hole_mm", kind == Provoked::perforation)) step.size = 1e-3 * object.number("hole_mm");
  if (only_of("grade", kind == Provoked::dissection))
    step.size = static_cast<double>(object.choice("grade", {"A", "B", "C", "D", "E", "F"}));
  if (only_of("share", kind == Provoked::spasm || kind == Provoked::no_reflow || kind == Provoked::vagal))
    step.size = object.number("share");
  if (only_of("clot_mm3", kind == Provoked::thrombus)) step.size = 1e-9 * object.number("clot_mm3");
  if (only_of("air_mL", kind == Provoked::air)) step.size = 1e-6 * object.number("air_mL");
}

/// What is given in an emergency.
void read_emergency(const JsonObject& object, ScriptStep& step) {
  constexpr double most_injected_m3 = 60e-6;
  if ((step.action == ScriptAction::inject || step.action == ScriptAction::aspirate) &&
      step.volume_m3 > most_injected_m3)
    object.refuse("volume_mL");
  if (step.action == ScriptAction::provoke) read_complication(object, step);
  if (object.has("hold")) step.breath_asked = 1 + static_cast<int>(object.choice("hold", {"in", "out"}));
  if (step.action != ScriptAction::give) return;
  step.drug = object.text("drug");
  if (object.has("dose_ug") == object.has("dose_mg"))
    object.value().fail(object.value().path() + " has no dose, or two; expected dose_ug or dose_mg");
  step.dose_unit = object.has("dose_ug") ? "ug" : "mg";
}

std::vector<int> read_tools(const JsonObject& object, const Script& script) {
  std::vector<int> tools;
  if (!object.has("tool")) return tools;
  const JsonValue& tool = object["tool"];
  if (tool.type != JsonValue::Type::array) return {tool_called(script, tool)};
  if (tool.items.empty()) object.refuse("tool");
  for (const JsonValue& one : tool.items) {
    tools.push_back(tool_called(script, one));
    if (std::count(tools.begin(), tools.end(), tools.back()) > 1) one.fail(one.path() + ": the tool is there twice");
  }
  return tools;
}

/// How fast the tools are moved, and until when.
void read_motion(const JsonObject& object, const Script& script, ScriptStep& step) {
  step.tools = read_tools(object, script);
  if (object.has("speed_mm_s"))
    step.feed_m_s = 1e-3 * object.number("speed_mm_s") * (step.action == ScriptAction::withdraw ? -1 : 1);
  if (object.has("turn_deg_s")) {
    if (object.number("turn_deg_s") == 0) object.refuse("turn_deg_s");
    step.turn_rad_s = degree * object.number("turn_deg_s");
  }
  step.until = read_conditions(object, "until", script, step.tools);
  step.unless = read_conditions(object, "unless", script, step.tools);
  if (object.has("timeout_s")) step.timeout_s = object.number("timeout_s");
}

ScriptStep read_step(const JsonValue& value, const Script& script) {
  const JsonObject object(value, script_keys::step);
  ScriptStep step;
  step.line = value.line;
  const std::size_t action = object.choice("do", action_names());
  assert(action < std::size(script_actions));  // steps that stand for others have been expanded by now
  require_keys(object);
  step.action = script_actions[action].action;
  if (object.has("label")) step.label = object.text("label");
  read_motion(object, script, step);
  if (object.has("tries")) {
    if (!object.has("otherwise")) object.refuse("tries");
    step.tries = object.whole("tries");
  }
  if (object.has("detour")) step.detour = object.boolean("detour");
  if (step.detour && script.steps.empty()) object.refuse("detour");
  read_view(object, step);
  if (object.has("on")) step.on = object.boolean("on");
  if (object.has("rate_1_min")) step.rate_1_min = object.number("rate_1_min");
  if (object.has("text")) step.text = object.text("text");
  if (step.action == ScriptAction::mark && step.text.empty() && step.label.empty())
    value.fail(value.path() + " marks nothing; expected text or label");
  read_treatment(object, step);
  read_emergency(object, step);
  return step;
}

/// Second pass, when all labels are known.
void read_otherwise(const JsonValue& value, Script& script, ScriptStep& step) {
  const JsonObject object(value, script_keys::step);
  if (object.has("last_resort") && !object.has("otherwise")) object.refuse("last_resort");
  if (!object.has("otherwise")) return;
  const std::string to = object.text("otherwise");
  if (to == "fail") return;
  if (to == "go on") {
    step.otherwise = ScriptStep::Otherwise::go_on;
    return;
  }
  const auto step_called = [&](const char* key) {
    const std::string label = object.text(key);
    const auto called = [&](const ScriptStep& one) { return one.label == label; };
    const auto found = std::find_if(script.steps.begin(), script.steps.end(), called);
    if (found == script.steps.end()) object.refuse(key);
    return static_cast<int>(found - script.steps.begin());
  };
  step.jump_to = step_called("otherwise");
  step.otherwise = ScriptStep::Otherwise::jump;
  if (object.has("last_resort")) step.last_resort = step_called("last_resort");
}

/// A detour is reached by its label, or from the detour before it; all other steps by those before them.
void require_reached(const std::vector<JsonValue>& values, const Script& script) {
  const auto end = script.steps.size();
  std::vector<bool> reached(end, false);
  std::vector<std::size_t> next = {0};
  while (!next.empty()) {
    const std::size_t s = next.back();
    next.pop_back();
    if (s >= end || reached[s]) continue;
    reached[s] = true;
    const ScriptStep& step = script.steps[s];
    next.push_back(script.after(s));
    for (const int to : {step.jump_to, step.last_resort})
      if (to >= 0) next.push_back(static_cast<std::size_t>(to));
  }
  for (std::size_t s = 0; s < end; ++s)
    if (!reached[s])
      values[s].fail(fmt::format(
          "{} is a detour that no step leads to, {}; expected its label as \"otherwise\" or \"last_resort\" of a step "
          "that is reached, or no \"detour\"",
          values[s].path(), script.steps[s].words()));
}

ScriptTool read_tool(const JsonObject& tool) {
  ScriptTool out{tool.text("name"), tool.text("instrument"), tool.value().line, {}, 0, 0, read_lesion(tool), {}};
  if (tool.has("over")) out.over = tool.text("over");
  if (tool.has("sizes") != (tool.has("of_reference") || tool.has("of_aorta")))
    tool.value().fail(tool.value().path() + " has sizes or what they are measured by; expected both or neither");
  if (tool.has("of_reference") && tool.has("of_aorta")) tool.refuse("of_aorta");
  if (tool.has("lesion") && !tool.has("of_reference")) tool.refuse("lesion");
  if (!tool.has("sizes")) return out;
  const char* measure = tool.has("of_aorta") ? "of_aorta" : "of_reference";
  (tool.has("of_aorta") ? out.of_aorta : out.of_reference) = tool.number(measure);
  if (tool.list("sizes").empty()) tool.refuse("sizes");
  for (const JsonValue& size : tool.list("sizes")) {
    if (size.type != JsonValue::Type::text || size.text.empty()) tool.refuse("sizes");
    out.sizes.push_back(size.text);
  }
  return out;
}

Script read(JsonValue file, const std::string& text) {
  const bool written_out = write_out_parts(file);
  const JsonObject root(file, script_keys::root);
  Script script;
  script.file = *file.file;
  script.source = written_out ? to_json(file) : text;
  script.name = root.text("name");
  script.title = root.text("title");
  if (root.has("access")) script.access = static_cast<vascular::Access>(root.choice("access", access_names()));
  if (root.has("lesions_in"))
    for (const JsonValue& branch : root.list("lesions_in")) {
      if (branch.type != JsonValue::Type::text || branch.text.empty()) root.refuse("lesions_in");
      script.lesions_in.push_back(branch.text);
    }
  if (root.list("tools").empty()) root.refuse("tools");
  for (const JsonValue& value : root.list("tools")) {
    const JsonObject tool(value, script_keys::tool);
    for (const ScriptTool& other : script.tools)
      if (other.name == tool.text("name")) value.fail(value.path() + ".name: there is another tool of that name");
    script.tools.push_back(read_tool(tool));
  }
  if (root.has("landmarks"))
    for (const JsonValue& value : root.list("landmarks")) {
      const JsonObject landmark(value, script_keys::landmark);
      const std::vector<double> mm = landmark.numbers("at_mm", 3);
      for (const ScriptLandmark& other : script.landmarks)
        if (other.name == landmark.text("name"))
          value.fail(value.path() + ".name: there is another landmark of that name");
      script.landmarks.push_back({landmark.text("name"), 1e-3 * Eigen::Vector3d(mm[0], mm[1], mm[2]), value.line});
    }
  const std::vector<JsonValue>& steps = root.list("steps");
  if (steps.empty()) root.refuse("steps");
  for (const JsonValue& value : steps) {
    script.steps.push_back(read_step(value, script));
    const std::string& label = script.steps.back().label;
    for (std::size_t s = 0; s + 1 < script.steps.size(); ++s)
      if (!label.empty() && script.steps[s].label == label)
        value.fail(value.path() + ".label: there is another step \"" + label + "\"");
  }
  for (std::size_t s = 0; s < steps.size(); ++s) read_otherwise(steps[s], script, script.steps[s]);
  require_reached(steps, script);
  return script;
}

}  // namespace

std::string ScriptStep::words() const {
  const std::string name = row_of(action).name;
  return label.empty() ? name : fmt::format("{} ({})", name, label);
}

std::size_t Script::after(std::size_t s) const {
  std::size_t next = s + 1;
  if (!steps[s].detour)
    while (next < steps.size() && steps[next].detour) ++next;
  return next;
}

Script read_script(const std::string& file, const std::string& text) { return read(parse_json(file, text), text); }

Script load_script(const std::string& file) {
  const std::string text = read_file(file, "a script NAME.json", json_limits::bytes);
  if (text.empty()) throw LoadError(file + ": holds nothing; expected a script");
  return read(parse_json(file, text), text);
}

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

void require_access(const Script& script, std::optional<vascular::Access> of_case, const std::string& case_name) {
  const auto name_of = [](vascular::Access access) { return access_names()[static_cast<std::size_t>(access)]; };
  if (script.access && of_case && *script.access != *of_case)
    throw LoadError(
        fmt::format("{}: is for {} access, and {} has {} access; expected a case and a script of one access",
                    script.file, name_of(*script.access), case_name, name_of(*of_case)));
}

Script find_script(const std::string& name_or_file) {
  const fs::path known = fs::path(data_folder()) / "scripts" / (name_or_file + ".json");
  if (is_file(known)) return load_script(known.string());
  if (name_or_file.ends_with(".json")) return load_script(name_or_file);
  if (is_there(name_or_file)) require_file(name_or_file, "a script's file NAME.json");
  std::string names;
  for (const Script& script : load_scripts()) names += "\n  " + script.name;
  throw LoadError(
      fmt::format("there is no script \"{}\"; expected a file NAME.json or one of:{}", name_or_file, names));
}

void refuse(const ScriptCondition& condition, const std::string& what) {
  throw LoadError(fmt::format("{}:{}: {}", condition.file, condition.line, what));
}

}  // namespace ostium::data
