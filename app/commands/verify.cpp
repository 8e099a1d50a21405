#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "app/command_line/command.h"
#include "app/command_line/common_options.h"
#include "app/command_line/progress.h"
#include "app/gates/gate.h"

namespace ostium::app {

namespace {

struct Arguments {
  std::string only;    ///< a gate's name, or a prefix of several
  bool quick = false;  ///< fewer elements and cases, the same tolerances
  bool json = false;
  bool list = false;  ///< list names and descriptions instead of running
};

void declare(Options& options, Arguments& a) {
  options.add("--only", a.only, "Only gates whose name begins with this").type("GATE");
  options.flag("--quick", a.quick, "Fewer elements and cases, the same tolerances");
  add_json_flag(options, a.json, "verify.schema.json");
  options.flag("--list", a.list, "Name the gates and what they compare, without running them");
}

int unknown_gate(const std::string& only) {
  fmt::print(stderr, "ostium verify: no gate begins with \"{}\". There are:\n", only);
  for (const gates::Gate& gate : gates::gates()) fmt::print(stderr, "  {}\n", gate.name);
  return 2;
}

void print_list(const std::vector<gates::Gate>& chosen, bool json) {
  if (json) {
    std::vector<std::pair<std::string, std::string>> names;
    for (const gates::Gate& gate : chosen) names.emplace_back(gate.name, gate.what);
    fmt::print("{}\n", data::names_to_json(names));
  } else {
    for (const gates::Gate& gate : chosen) fmt::print("{:<16} {}\n", gate.name, gate.what);
  }
}

/// Exit code: 0 all pass, 1 a gate fails, 2 `only` names no gate. Results go to stdout.
int run(const Arguments& a) {
  const auto chosen = gates::selected(a.only);
  if (chosen.empty()) return unknown_gate(a.only);
  if (a.list) {
    print_list(chosen, a.json);
    return 0;
  }
  const auto start = std::chrono::steady_clock::now();
  std::vector<data::GateResult> results;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    show_progress(fmt::format("[{}/{}] {}", i + 1, chosen.size(), chosen[i].what));
    const auto found = gates::run(chosen[i], a.only, a.quick);
    show_progress("");
    if (!a.json && results.empty() && !found.empty()) fmt::print("{}\n", data::table_heading());
    for (const data::GateResult& result : found) {
      results.push_back(result);
      if (!a.json) fmt::print("{}\n", table_line(result));
    }
    std::fflush(stdout);
  }
  if (results.empty()) return unknown_gate(a.only);
  if (a.json) {
    fmt::print("{}\n", to_json(results));
  } else {
    const auto passed =
        std::count_if(results.begin(), results.end(), [](const data::GateResult& r) { return r.pass(); });
    fmt::print("{} of {} pass, in {:.1f} s\n", passed, results.size(),
               std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return all_pass(results) ? 0 : 1;
}

}  // namespace

Command verify_command() {
  return make_command("verify", "Run the physics gates: value, reference, tolerance, pass",
                      {"ostium verify", "ostium verify --only rod-static", "ostium verify --quick --json > gates.json"},
                      declare, run);
}

}  // namespace ostium::app
