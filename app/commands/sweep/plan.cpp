#include "app/commands/sweep/plan.h"

#include <fmt/format.h>

#include <map>

#include "app/command_line/arguments.h"
#include "data/formats/decimal.h"
#include "data/formats/load_error.h"

namespace ostium::app {

namespace {

constexpr std::uint64_t most_runs = 1'000'000;  // each keeps its setup in memory

std::pair<std::uint64_t, std::uint64_t> seeds_of(const std::string& text) {
  const auto dots = text.find("..");
  const std::optional<std::uint64_t> from = data::whole(text.substr(0, dots));
  const std::optional<std::uint64_t> to = dots == std::string::npos ? from : data::whole(text.substr(dots + 2));
  if (!from || !to || *to < *from || *to - *from >= most_runs)
    throw data::LoadError(fmt::format(
        "--seeds is \"{}\"; expected FROM..TO, or one: whole numbers from 0 on, at most {} of them", text, most_runs));
  return {*from, *to};
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
      if (sweep.tasks.size() + (last - first) >= most_runs)
        throw data::LoadError(
            fmt::format("the sweep has more than {} runs; expected fewer: vessels times values of "
                        "--vary times --seeds",
                        most_runs));
      for (std::uint64_t n = 0; n <= last - first; ++n) {
        task.seed = task.setup.seed = first + n;
        sweep.tasks.push_back(task);
      }
    } while (next(values, at));
  }
  return sweep;
}

}  // namespace ostium::app
