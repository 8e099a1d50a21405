#include "app/session/operator/setup.h"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>

#include "core/base/field_numbers.h"
#include "data/catalogue/case/anatomy_file.h"
#include "data/catalogue/catalogue.h"
#include "data/catalogue/drug/drug_file.h"
#include "data/catalogue/instrument/instrument_reader.h"
#include "data/formats/decimal.h"
#include "data/formats/load_error.h"
#include "data/formats/read_file.h"
#include "vascular/flow/coronary_roots.h"
#include "vascular/geometry/mesh_files/formats.h"

namespace ostium::app {

namespace {

namespace fs = std::filesystem;

/// What --set gives beside the tools' instruments.
constexpr std::string_view settings[] = {"person",     "heart_rate", "breathing", "arteries",
                                         "hand_speed", "friction",   "begin",     "stuck"};

fs::path folder_of(const data::Script& script) { return fs::path(script.file).parent_path(); }

nlohmann::json numbers(const Eigen::Vector3d& p) { return nlohmann::json::array({p.x(), p.y(), p.z()}); }
Eigen::Vector3d point(const nlohmann::json& p) {
  return {p.at(0).get<double>(), p.at(1).get<double>(), p.at(2).get<double>()};
}

/// Names stay while what lies in their files may be another.
std::string shape_of(const vascular::Mesh& mesh, const std::vector<std::vector<Eigen::Vector3d>>& frames = {},
                     const std::string& more = "") {
  std::uint64_t hash = core::hash_bytes(more.data(), more.size(), 0);
  const auto add = [&](const auto& rows) {
    hash = core::hash_bytes(rows.data(), rows.size() * sizeof(*rows.data()), hash);
  };
  add(mesh.vertices), add(mesh.triangles);
  std::ranges::for_each(frames, add);
  return fmt::format("{:016x}", hash);
}

std::string shape_of(const data::Case& c) {
  if (!c.imported) return "";
  return shape_of(c.imported->lumen, c.imported->frames, data::anatomy_to_json(c.imported->anatomy));
}

}  // namespace

void set_vessel(const std::string& case_or_mesh, vascular::LengthUnit unit, RunSetup& setup) {
  setup.vessel = case_or_mesh;
  if (vascular::names_mesh(case_or_mesh)) {
    setup.mesh = read_mesh(case_or_mesh, unit).mesh;
    setup.shape = shape_of(setup.mesh);
    return;
  }
  const fs::path file = fs::absolute(data::case_file(case_or_mesh));
  const data::Case c = data::load_case(file.string());
  setup.case_text = data::read_file(file.string());
  setup.shape = shape_of(c);
  if (!c.imported) setup.access = c.anatomy.access;
  // An imported case's vessels are stored beside its file, where replay finds them.
  setup.vessel = c.imported ? (file.parent_path() / c.name).string() : c.name;
}

namespace {

std::string file_of(const data::ScriptTool& tool, const data::Script& script) {
  try {
    return data::instrument_file(tool.instrument, folder_of(script));
  } catch (const data::LoadError& error) {
    throw data::LoadError(fmt::format("{}:{}: {}: {}", script.file, tool.line, tool.name, error.what()));
  }
}

}  // namespace

void set_script(const data::Script& script, RunSetup& setup) {
  data::require_access(script, setup.access, setup.vessel);
  setup.script = script;
  setup.tool_texts.clear(), setup.tool_files.clear();
  for (const data::ScriptTool& tool : script.tools) {
    if (std::ranges::find(settings, tool.name) != std::end(settings))
      throw data::LoadError(
          fmt::format("{}:{}: a tool is called {}, as what --set gives beside tools; expected another "
                      "name",
                      script.file, tool.line, tool.name));
    setup.tool_files.push_back(file_of(tool, script));
    setup.tool_texts.push_back(data::read_file(setup.tool_files.back()));
  }
  setup.drug_files = data::drug_files(), setup.drug_texts.clear();
  for (const std::string& file : setup.drug_files) setup.drug_texts.push_back(data::read_file(file));
}

namespace {

/// Largest diameter that fits; empty if there is nothing to measure.
std::optional<double> most_that_fits_m(const Vessel& vessel, const data::Script& script, const data::ScriptTool& tool) {
  if (tool.of_aorta > 0) {
    const double aorta_m = ascending_diameter_m(vessel);
    return aorta_m > 0 ? std::optional(tool.of_aorta * aorta_m) : std::nullopt;
  }
  if (!vessel.coronaries || vessel.coronaries->lesions.empty()) return std::nullopt;
  if (static_cast<std::size_t>(tool.lesion) >= vessel.coronaries->lesions.size())
    throw data::LoadError(fmt::format("{}:{}: {} is for lesion {}; this patient's lesions are {}", script.file,
                                      tool.line, tool.name, tool.lesion + 1, vessel.coronaries->lesions.size()));
  return tool.of_reference * vessel.coronaries->lesions[static_cast<std::size_t>(tool.lesion)].reference_m;
}

double width_of(const data::Instrument& instrument, const data::Script& script, const data::ScriptTool& tool) {
  if (tool.of_aorta > 0 && instrument.width_m > 0) return instrument.width_m;
  if (tool.of_reference > 0 && instrument.balloon) return instrument.balloon->nominal_m;
  throw data::LoadError(fmt::format("{}:{}: {} {}", script.file, tool.line, instrument.name,
                                    tool.of_aorta > 0 ? "does not say its width_mm; expected sizes of a guide that does"
                                                      : "has no balloon; expected sizes of a balloon or a stent"));
}

}  // namespace

std::vector<std::string> choose_sizes(const Vessel& vessel, RunSetup& setup) {
  std::vector<std::string> chosen;
  for (std::size_t t = 0; t < setup.script.tools.size(); ++t) {
    const data::ScriptTool& tool = setup.script.tools[t];
    if (tool.sizes.empty()) continue;
    const std::optional<double> most_m = most_that_fits_m(vessel, setup.script, tool);
    if (!most_m) continue;
    double best_m = 0;
    for (const std::string& size : tool.sizes) {
      const std::string file = data::instrument_file(size, folder_of(setup.script)), text = data::read_file(file);
      const double own_m = width_of(data::read_instrument(file, text), setup.script, tool);
      const bool better = best_m == 0 || (own_m <= *most_m ? best_m > *most_m || own_m > best_m : own_m < best_m);
      if (!better) continue;
      best_m = own_m;
      setup.tool_files[t] = file, setup.tool_texts[t] = text;
    }
    if (best_m > 0)
      chosen.push_back(tool.name + ": " + data::read_instrument(setup.tool_files[t], setup.tool_texts[t]).title);
  }
  return chosen;
}

namespace {

double number(const std::string& key, const std::string& text, double least, double most, const char* expected) {
  const std::optional<double> value = data::decimal(text);
  if (!value || *value < least || *value > most)
    throw data::LoadError(fmt::format("{} is \"{}\"; expected {}", key, text, expected));
  return *value;
}

/// Before a case is built; a mesh, which has no ostium that is known, says so itself. "": from the groin or wrist.
void require_root(const std::string& artery, const RunSetup& setup) {
  if (artery.empty() || setup.is_mesh()) return;
  const auto known = coronary_roots(anatomy_of(data::read_case(setup.vessel + ".json", setup.case_text)));
  if (std::ranges::find(known, artery) != known.end()) return;
  const std::string expected = known.empty() ? "this vessel has none" : fmt::format("{}", fmt::join(known, " or "));
  throw data::LoadError(
      fmt::format("begin is \"{}\"; expected a coronary artery that leaves the aorta: {}", artery, expected));
}

/// Wires go for wires, catheters for catheters, balloons and stents for one another.
int family_of(data::InstrumentKind kind) {
  using enum data::InstrumentKind;
  return kind == wire ? 0 : kind == balloon_shaft || kind == stent_shaft ? 2 : 1;
}

void set_tool(std::size_t t, const std::string& instrument, RunSetup& setup) {
  const std::string file = data::instrument_file(instrument), text = data::read_file(file);
  const data::InstrumentKind was = data::read_instrument(setup.tool_files[t], setup.tool_texts[t]).kind,
                             is = data::read_instrument(file, text).kind;
  if (family_of(was) != family_of(is))
    throw data::LoadError(fmt::format("{} is set to {}, a {}; expected a {}, as the script's",
                                      setup.script.tools[t].name, instrument, data::words_for(is),
                                      data::words_for(was)));
  setup.tool_files[t] = file, setup.tool_texts[t] = text;
  setup.script.tools[t].sizes.clear();
}

}  // namespace

void set_value(const std::string& key, const std::string& value, RunSetup& setup) {
  std::string known;
  for (std::size_t t = 0; t < setup.script.tools.size(); ++t) {
    known += setup.script.tools[t].name + ", ";
    if (setup.script.tools[t].name == key) return set_tool(t, value, setup);
  }
  if (key == "person") {
    const double person = number(key, value, 0, 9e15, "a whole number from 0 on");
    if (person != std::floor(person) || setup.is_mesh())
      throw data::LoadError(fmt::format("person is \"{}\"; expected a whole number from 0 on, and a case", value));
    setup.person = static_cast<std::uint64_t>(person);
  } else if (key == "heart_rate") {
    setup.rate_1_min = number(key, value, 40, 180, "beats a minute, 40 to 180");
  } else if (key == "breathing") {
    constexpr const char* expected = "breaths a minute of a case's patient, 4 to 60, or 0";
    if (const double rate = number(key, value, 0, 60, expected); rate == 0 || (rate >= 4 && !setup.is_mesh()))
      setup.breaths_1_min = rate;
    else
      throw data::LoadError(fmt::format("breathing is \"{}\"; expected {}", value, expected));
  } else if (key == "arteries") {
    if ((value != "rigid" && value != "yield") || (value == "yield" && setup.is_mesh()))
      throw data::LoadError(
          fmt::format("arteries is \"{}\"; expected rigid, or yield for those of a case's patient", value));
    setup.arteries_yield = value == "yield";
  } else if (key == "hand_speed") {
    setup.hand_speed = number(key, value, 0.01, 10, "how many times the script's speeds, 0.01 to 10");
  } else if (key == "friction") {
    setup.friction = number(key, value, 0, 1, "the wall's coefficient of friction, 0 to 1");
  } else if (key == "begin") {
    require_root(value, setup);
    setup.begin = value;
  } else if (key == "stuck") {
    const auto named = [&](const data::ScriptTool& tool) { return tool.name == value; };
    if (std::none_of(setup.script.tools.begin(), setup.script.tools.end(), named))
      throw data::LoadError(fmt::format("stuck is \"{}\"; expected one of {}of the script", value, known));
    setup.stuck = value;
  } else {
    throw data::LoadError(
        fmt::format("there is no \"{}\" to set; expected one of {}{}", key, known, fmt::join(settings, ", ")));
  }
}

std::shared_ptr<const Vessel> make_vessel(const RunSetup& setup, std::string& warnings) {
  std::shared_ptr<const Vessel> vessel;
  if (setup.is_mesh()) {
    vessel = vessel_of(setup.vessel, setup.mesh, setup.entry, warnings);
  } else {
    const data::Case c = data::read_case(setup.vessel + ".json", setup.case_text);
    if (!setup.shape.empty() && setup.shape != shape_of(c))
      throw data::LoadError(
          setup.vessel +
          ": its vessels have changed since; expected the case as it was then: import it again as it was");
    vessel = vessel_of(c, setup.person);
  }
  malloc_trim(0);  // returns the memory used while building to the system
  return vessel;
}

namespace {

/// Of what comes in through the vessel's own entry: what is too thick would be forced into the wall.
void require_room(const std::vector<SessionTool>& tools, const Vessel& vessel) {
  constexpr double near_m = 10e-3;  // at its end, a vessel is measured too narrow
  double widest_m = 0;
  for (const vascular::TreeBranch& branch : vessel.way->branches())
    for (const vascular::TreeSphere& sphere : branch.spheres)
      if ((sphere.p - vessel.entry.p_W).norm() < near_m + sphere.radius_m)
        widest_m = std::max(widest_m, 2 * sphere.radius_m);
  for (const SessionTool& tool : tools)
    if (widest_m > 0 && tool.instrument.outer_diameter_m > widest_m)
      throw data::LoadError(fmt::format(
          "{}: is {:.2f} mm wide where instruments come in, and {} is {:.2f} mm thick; expected a thinner one, another "
          "entry, or another unit of the mesh",
          vessel.name, 1e3 * widest_m, tool.name, 1e3 * tool.instrument.outer_diameter_m));
}

}  // namespace

SessionModel make_session(const RunSetup& setup, std::shared_ptr<const Vessel> vessel) {
  std::vector<SessionTool> tools;
  for (std::size_t t = 0; t < setup.script.tools.size(); ++t)
    tools.push_back({setup.script.tools[t].name, data::read_instrument(setup.tool_files[t], setup.tool_texts[t]),
                     setup.script.tools[t].over});
  if (setup.begin.empty()) require_room(tools, *vessel);
  std::vector<vascular::Drug> drugs;
  for (std::size_t d = 0; d < setup.drug_texts.size(); ++d)
    drugs.push_back(data::read_drug(setup.drug_files[d], setup.drug_texts[d]));
  return make_session(std::move(vessel), std::move(tools),
                      {.seed = setup.seed,
                       .breaths_1_min = setup.breaths_1_min,
                       .arteries_yield = setup.arteries_yield,
                       .friction = setup.friction,
                       .begin = setup.begin,
                       .drugs = std::move(drugs)});
}

std::string to_json(const RunSetup& setup) {
  nlohmann::ordered_json out = {{"vessel", setup.vessel}, {"seed", setup.seed}};
  if (setup.is_mesh())
    out["entry_m"] = {numbers(setup.entry.p_P), numbers(setup.entry.towards_P)};
  else
    out["case"] = setup.case_text;
  if (!setup.shape.empty()) out["shape"] = setup.shape;
  if (setup.person) out["person"] = *setup.person;
  if (setup.rate_1_min) out["heart_rate_1_min"] = *setup.rate_1_min;
  if (setup.breaths_1_min > 0) out["breathing_1_min"] = setup.breaths_1_min;
  if (setup.arteries_yield) out["arteries"] = "yield";
  if (setup.friction) out["friction"] = *setup.friction;
  if (!setup.begin.empty()) out["begin"] = setup.begin;
  if (!setup.stuck.empty()) out["stuck"] = setup.stuck;
  out["hand_speed"] = setup.hand_speed;
  out["script"] = {{"file", fs::path(setup.script.file).filename()}, {"text", setup.script.source}};
  for (std::size_t t = 0; t < setup.tool_texts.size(); ++t)
    out["tools"].push_back({{"file", fs::path(setup.tool_files[t]).filename()}, {"text", setup.tool_texts[t]}});
  for (std::size_t d = 0; d < setup.drug_texts.size(); ++d)
    out["drugs"].push_back({{"file", fs::path(setup.drug_files[d]).filename()}, {"text", setup.drug_texts[d]}});
  return out.dump(2);
}

RunSetup setup_from_json(const std::string& file, const std::string& text) {
  try {
    const auto in = nlohmann::json::parse(text);
    RunSetup setup;
    setup.vessel = in.at("vessel");
    setup.seed = in.at("seed");
    if (in.contains("shape")) setup.shape = in.at("shape");
    if (in.contains("case")) setup.case_text = in.at("case");
    if (in.contains("entry_m")) setup.entry = {point(in.at("entry_m").at(0)), point(in.at("entry_m").at(1))};
    if (in.contains("person")) setup.person = in.at("person");
    if (in.contains("heart_rate_1_min")) setup.rate_1_min = in.at("heart_rate_1_min");
    if (in.contains("breathing_1_min")) setup.breaths_1_min = in.at("breathing_1_min");
    if (in.contains("arteries")) setup.arteries_yield = in.at("arteries") == "yield";
    if (in.contains("begin")) setup.begin = in.at("begin");
    if (in.contains("stuck")) setup.stuck = in.at("stuck");
    if (in.contains("friction")) setup.friction = in.at("friction");
    setup.hand_speed = in.at("hand_speed");
    setup.script = data::read_script(in.at("script").at("file"), in.at("script").at("text"));
    for (const auto& tool : in.at("tools")) {
      setup.tool_files.push_back(tool.at("file"));
      setup.tool_texts.push_back(tool.at("text"));
    }
    if (in.contains("drugs"))
      for (const auto& drug : in.at("drugs")) {
        setup.drug_files.push_back(drug.at("file"));
        setup.drug_texts.push_back(drug.at("text"));
      }
    if (setup.tool_texts.size() != setup.script.tools.size())
      throw data::LoadError(file + ": has another number of instruments than its script has tools");
    return setup;
  } catch (const nlohmann::json::exception& error) {
    const std::string words = error.what();  // "[json.exception.parse_error.101] ..."
    throw data::LoadError(fmt::format("{}: its setup cannot be read: {}", file, words.substr(words.find("] ") + 2)));
  }
}

}  // namespace ostium::app
