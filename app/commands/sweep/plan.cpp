#include "app/commands/sweep/plan.h"

#include <fmt/format.h>

#include <cstdio>
#include <map>

#include "app/command_line/arguments.h"
#include "data/formats/load_error.h"

namespace ostium::app {

namespace {

std::pair<std::uint64_t, std::uint64_t> seeds_of(const std::string& text) {
  unsigned long long from = 0, to = 0;
  char rest;
  const int read = std::sscanf(text.c_str(), "%llu..%llu%c", &from, &to, &rest);
  if (text.find_first_not_of("0123456789.") != std::string::npos ||
      (read != 2 && text.find('.') != std::string::npos) || read < 1 || (read == 2 && to < from))
    throw data::LoadError(fmt::format("--seeds is \"{}\"; expected FROM..TO", text));
  return {from, read == 2 ? to : from};
}

using Values = std::vector<std::vector<std::string>>;  // of each varied key

Values values_of(const SweepArguments& a, std::vector<std::string>& keys) {
  Values values;
  for (const std::string& vary : a.vary) {
    const auto [key, list] = key_and_value(vary);
    if (key.empty() || list.empty()) throw data::LoadError(fmt::format("--vary {}: expected KEY=A,B,C", vary));
    keys.push_back(key);
    values.push_back(split(list, ','));
  }
  return values;
}

/// Advances to the next combination; the last key's values change fastest. False if there are no more.
bool next(const Values& values, std::vector<std::size_t>& at) {
  for (std::size_t k = values.size(); k-- > 0;) {
    if (++at[k] < values[k].size()) return true;
    at[k] = 0;
  }
  return false;
}

}  // namespace

Sweep plan_sweep(const SweepArguments& a) {
  Sweep sweep;
  const Values values = values_of(a, sweep.keys);
  const auto [first, last] = seeds_of(a.seeds);
  std::map<std::pair<std::string, std::string>, std::size_t> made;  // by vessel and person
  for (const std::string& vessel : a.vessels) {
    SessionArguments session = a.session;
    session.vessel = vessel;
    const RunSetup base = setup_of(session);
    std::vector<std::size_t> at(values.size(), 0);
    do {
      SweepTask task;
      task.setup = base;
      for (std::size_t k = 0; k < values.size(); ++k) {
        task.values.push_back(values[k][at[k]]);
        set_value(sweep.keys[k], values[k][at[k]], task.setup);
      }
      const std::string person = task.setup.person ? std::to_string(*task.setup.person) : "";
      const auto [found, is_new] = made.try_emplace({vessel, person}, sweep.vessels.size());
      if (is_new) sweep.vessels.push_back(task.setup);
      task.vessel = found->second;
      task.setup.mesh = {};
      for (std::uint64_t seed = first; seed <= last; ++seed) {
        task.seed = task.setup.seed = seed;
        sweep.tasks.push_back(task);
      }
    } while (next(values, at));
  }
  return sweep;
}

}  // namespace ostium::app
