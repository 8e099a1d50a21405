#include "app/session/setup.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "data/catalogue.h"
#include "data/instrument_reader.h"
#include "data/load_error.h"

namespace ostium {

namespace {

namespace fs = std::filesystem;

std::string all_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw LoadError(file + ": cannot be read; expected a file");
  return {std::istreambuf_iterator<char>(in), {}};
}

bool is_mesh_file(const std::string& name) {
  const std::string ending = fs::path(name).extension().string();
  return ending == ".obj" || ending == ".stl" || ending == ".ply";
}

std::string instrument_file(const std::string& name_or_file) {
  const fs::path known = fs::path(data_folder()) / "instruments" / (name_or_file + ".json");
  if (fs::is_regular_file(known)) return known.string();
  if (name_or_file.ends_with(".json")) return name_or_file;
  find_instrument(load_catalogue(), name_or_file);  // throws with what there is
  return known.string();
}

nlohmann::json numbers(const Eigen::Vector3d& p) { return nlohmann::json::array({p.x(), p.y(), p.z()}); }
Eigen::Vector3d point(const nlohmann::json& p) {
  return {p.at(0).get<double>(), p.at(1).get<double>(), p.at(2).get<double>()};
}

}  // namespace

void set_vessel(const std::string& case_or_mesh, LengthUnit unit, RunSetup& setup) {
  setup.vessel = case_or_mesh;
  if (is_mesh_file(case_or_mesh)) {
    setup.mesh = read_mesh(case_or_mesh, unit).mesh;
    return;
  }
  if (case_or_mesh.ends_with(".json")) {
    setup.case_text = all_of(case_or_mesh);
    setup.vessel = load_case(case_or_mesh).name;
    return;
  }
  find_case(case_or_mesh);  // throws with what there is
  setup.case_text = all_of((fs::path(data_folder()) / "cases" / (case_or_mesh + ".json")).string());
}

void set_script(const Script& script, const std::map<std::string, std::string>& replaced, RunSetup& setup) {
  setup.script = script;
  setup.tool_texts.clear(), setup.tool_files.clear();
  std::map<std::string, std::string> left = replaced;
  for (const ScriptTool& tool : script.tools) {
    std::string name = tool.instrument;
    if (const auto other = left.find(tool.name); other != left.end()) name = other->second, left.erase(other);
    setup.tool_files.push_back(instrument_file(name));
    setup.tool_texts.push_back(all_of(setup.tool_files.back()));
  }
  if (left.empty()) return;
  std::string known;
  for (const ScriptTool& tool : script.tools) known += (known.empty() ? "" : ", ") + tool.name;
  throw LoadError(fmt::format("{} has no tool \"{}\"; expected one of {}", script.file, left.begin()->first, known));
}

std::shared_ptr<const Vessel> make_vessel(const RunSetup& setup, std::string& warnings) {
  if (setup.is_mesh()) return vessel_of(setup.vessel, setup.mesh, setup.entry, warnings);
  return vessel_of(read_case(setup.vessel + ".json", setup.case_text), setup.person);
}

SessionModel make_session(const RunSetup& setup, std::shared_ptr<const Vessel> vessel) {
  std::vector<SessionTool> tools;
  for (std::size_t t = 0; t < setup.script.tools.size(); ++t)
    tools.push_back({setup.script.tools[t].name, read_instrument(setup.tool_files[t], setup.tool_texts[t])});
  return make_session(std::move(vessel), std::move(tools));
}

std::string to_json(const RunSetup& setup) {
  nlohmann::ordered_json out = {{"vessel", setup.vessel}, {"seed", setup.seed}};
  if (setup.is_mesh())
    out["entry_m"] = {numbers(setup.entry.p_P), numbers(setup.entry.towards_P)};
  else
    out["case"] = setup.case_text;
  if (setup.person) out["person"] = *setup.person;
  if (setup.rate_1_min) out["heart_rate_1_min"] = *setup.rate_1_min;
  out["script"] = {{"file", fs::path(setup.script.file).filename()}, {"text", setup.script.source}};
  for (std::size_t t = 0; t < setup.tool_texts.size(); ++t)
    out["tools"].push_back({{"file", fs::path(setup.tool_files[t]).filename()}, {"text", setup.tool_texts[t]}});
  return out.dump(2);
}

RunSetup setup_from_json(const std::string& file, const std::string& text) {
  try {
    const auto in = nlohmann::json::parse(text);
    RunSetup setup;
    setup.vessel = in.at("vessel");
    setup.seed = in.at("seed");
    if (in.contains("case")) setup.case_text = in.at("case");
    if (in.contains("entry_m")) setup.entry = {point(in.at("entry_m").at(0)), point(in.at("entry_m").at(1))};
    if (in.contains("person")) setup.person = in.at("person");
    if (in.contains("heart_rate_1_min")) setup.rate_1_min = in.at("heart_rate_1_min");
    setup.script = read_script(in.at("script").at("file"), in.at("script").at("text"));
    for (const auto& tool : in.at("tools")) {
      setup.tool_files.push_back(tool.at("file"));
      setup.tool_texts.push_back(tool.at("text"));
    }
    if (setup.tool_texts.size() != setup.script.tools.size())
      throw LoadError(file + ": has another number of instruments than its script has tools");
    return setup;
  } catch (const nlohmann::json::exception& error) {
    throw LoadError(fmt::format("{}: its setup cannot be read: {}", file, error.what()));
  }
}

}  // namespace ostium
