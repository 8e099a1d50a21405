#include "app/commands/sweep/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "app/command_line/arguments.h"
#include "data/formats/decimal.h"
#include "data/formats/load_error.h"

namespace ostium::app {

namespace {

void read_seeds(const std::string& text, SweepGrid& grid) {
  constexpr std::uint64_t most = 1'000'000;
  const auto dots = text.find("..");
  const std::optional<std::uint64_t> from = data::whole(text.substr(0, dots));
  const std::optional<std::uint64_t> to = dots == std::string::npos ? from : data::whole(text.substr(dots + 2));
  if (!from || !to || *to < *from || *to - *from >= most)
    throw data::LoadError(fmt::format(
        "--seeds is \"{}\"; expected FROM..TO, or one: whole numbers from 0 on, at most {} of them", text, most));
  grid.first_seed = *from, grid.last_seed = *to;
}

/// What is there twice would make the same runs twice; so would a number that is written in two ways.
void require_distinct(std::vector<std::string> values, const std::string& option) {
  for (std::string& value : values)
    if (const std::optional<double> number = data::decimal(value)) value = fmt::format("{}", *number);
  std::ranges::sort(values);
  if (const auto twice = std::ranges::adjacent_find(values); twice != values.end())
    throw data::LoadError(
        fmt::format("{} has {} twice; expected each once", option, twice->empty() ? "nothing" : *twice));
}

void read_values(const SweepArguments& a, SweepGrid& grid) {
  for (const std::string& vary : a.vary) {
    const auto [key, list] = key_and_value(vary);
    if (key.empty() || list.empty()) throw data::LoadError(fmt::format("--vary {}: expected KEY=A,B,C", vary));
    grid.keys.push_back(key);
    grid.values.push_back(split(list, ','));
    require_distinct(grid.values.back(), "--vary " + key);
    for (const std::string& set : a.session.set)
      if (key_and_value(set).first == key)
        throw data::LoadError(fmt::format("--set and --vary both give {}; expected one of them", key));
  }
  require_distinct(grid.keys, "--vary");
  require_distinct(a.vessels, "the list of cases");
}

}  // namespace

Sweep plan_sweep(const SweepArguments& a) {
  Sweep sweep;
  sweep.seconds = a.session.seconds;
  SweepGrid& grid = sweep.grid;
  read_seeds(a.seeds, grid);
  read_values(a, grid);
  grid.cases = a.vessels;
  require_size(grid);
  const std::size_t combinations = grid.combinations();
  std::map<std::pair<std::string, std::string>, std::size_t> made;  // by vessel and person
  for (std::size_t v = 0; v < a.vessels.size(); ++v) {
    SessionArguments session = a.session;
    session.vessel = a.vessels[v];
    const RunSetup base = setup_of(session);
    grid.cases[v] = base.vessel, grid.script = base.script.name;
    for (std::size_t c = 0; c < combinations; ++c) {
      RunSetup setup = base;
      const std::vector<std::string> values = grid.values_of(v * combinations + c);
      for (std::size_t k = 0; k < values.size(); ++k) set_value(grid.keys[k], values[k], setup);
      const std::string person = setup.person ? std::to_string(*setup.person) : "";
      const auto [found, is_new] = made.try_emplace({a.vessels[v], person}, sweep.vessels.size());
      if (is_new) sweep.vessels.push_back(setup);
      sweep.vessel_of.push_back(found->second);
      setup.mesh = {};
      sweep.settings.push_back(std::move(setup));
    }
  }
  return sweep;
}

RunSetup setup_of(const Sweep& sweep, std::size_t run) {
  RunSetup setup = sweep.settings[sweep.grid.setting_of(run)];
  setup.seed = sweep.grid.seed_of(run);
  return setup;
}

}  // namespace ostium::app
