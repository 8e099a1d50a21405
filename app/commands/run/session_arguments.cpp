#include "app/commands/run/session_arguments.h"

#include <fmt/format.h>

#include <set>

#include "app/command_line/arguments.h"
#include "app/command_line/common_options.h"
#include "app/command_line/mesh_unit.h"
#include "data/formats/load_error.h"
#include "vascular/geometry/mesh/length_unit.h"
#include "vascular/geometry/mesh_files/formats.h"

namespace ostium::app {

void add_session_options(Options& options, SessionArguments& a) {
  options.add("--script", a.script, "One of `ostium scripts`, or a file").type("NAME|FILE").show_default();
  options
      .add("--set", a.set,
           "A tool's instrument (NAME or FILE.json), or person, heart_rate, breathing (breaths a minute), arteries "
           "(rigid, "
           "yield), hand_speed, friction, begin (an artery), stuck (a tool whose drive is out)")
      .type("KEY=VALUE");
  options.add("--seconds", a.seconds, "Most that are simulated").range(0.001, 36000.0);
  add_unit_option(options, a.unit, "What a number in a mesh means");
  options.add("--entry", a.entry, "Of a mesh: where instruments come in").type("X,Y,Z");
  options.add("--towards", a.towards, "Of a mesh: a point that the way in leads to").type("X,Y,Z");
}

namespace {

/// "X,Y,Z" in the mesh's unit.
Eigen::Vector3d point(const std::string& text, const char* option, vascular::LengthUnit unit) {
  if (const auto numbers = three_numbers(text)) return metres(unit) * *numbers;
  throw data::LoadError(fmt::format("{} is \"{}\"; expected three numbers: X,Y,Z", option, text));
}

}  // namespace

RunSetup setup_of(const SessionArguments& a) {
  RunSetup setup;
  setup.seed = a.seed;
  if (vascular::names_mesh(a.vessel)) {
    if (a.entry.empty() || a.towards.empty())
      throw data::LoadError(a.vessel +
                            " is a mesh: --entry X,Y,Z and --towards X,Y,Z say where an instrument comes in");
    const auto raw = read_mesh(a.vessel, vascular::LengthUnit::metre, 0).mesh;
    const MeshUnit found = unit_of({a.vessel}, raw, a.unit);
    require_known(a.vessel, found);
    const vascular::LengthUnit unit = found.unit;
    set_vessel(a.vessel, unit, setup);
    setup.entry = {point(a.entry, "--entry", unit), point(a.towards, "--towards", unit)};
  } else if (!a.entry.empty() || !a.towards.empty()) {
    throw data::LoadError("--entry and --towards are for a mesh; a case has its access");
  } else if (a.unit != "auto") {
    throw data::LoadError("--units is for a mesh; a case has its own");
  } else {
    set_vessel(a.vessel, {}, setup);
  }
  set_script(data::find_script(a.script), setup);
  std::set<std::string> known;
  for (const std::string& set : a.set) {
    const auto [key, value] = key_and_value(set);
    if (key.empty()) throw data::LoadError(fmt::format("--set {}: expected KEY=VALUE", set));
    if (!known.insert(key).second)
      throw data::LoadError(fmt::format("--set {}: {} is set already; expected one value", set, key));
    set_value(key, value, setup);
  }
  return setup;
}

}  // namespace ostium::app
