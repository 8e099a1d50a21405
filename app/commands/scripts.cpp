#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/command_line/command.h"
#include "app/command_line/common_options.h"
#include "data/catalogue/script/script.h"

namespace ostium::app {

namespace {

struct Arguments {
  bool json = false;
};

void declare(Options& options, Arguments& a) { add_json_flag(options, a.json); }

int run(const Arguments& a) {
  const std::vector<data::Script> scripts = data::load_scripts();
  if (a.json) {
    auto out = nlohmann::ordered_json::array();
    for (const data::Script& s : scripts) {
      nlohmann::ordered_json tools;
      for (const data::ScriptTool& tool : s.tools)
        tools.push_back({{"name", tool.name}, {"instrument", tool.instrument}});
      out.push_back({{"name", s.name}, {"title", s.title}, {"steps", s.steps.size()}, {"tools", tools}});
    }
    fmt::print("{}\n", out.dump(2));
    return 0;
  }
  std::size_t width = 0;
  for (const data::Script& s : scripts) width = std::max(width, s.name.size());
  for (const data::Script& s : scripts) fmt::print("{:<{}} {:>2} steps  {}\n", s.name, width, s.steps.size(), s.title);
  return 0;
}

}  // namespace

Command scripts_command() {
  return make_command("scripts", "What scripts there are to run", {"ostium scripts", "ostium scripts --json"}, declare,
                      run);
}

}  // namespace ostium::app
