#include "app/verify_command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "app/verify/gate.h"

namespace ostium {

namespace {

int unknown_gate(const std::string& only) {
  fmt::print(stderr, "ostium verify: no gate begins with \"{}\". There are:\n", only);
  for (const verify::Gate& gate : verify::gates()) fmt::print(stderr, "  {}\n", gate.name);
  return 2;
}

}  // namespace

int verify_command(const VerifyOptions& options) {
  const auto chosen = verify::selected(options.only);
  if (chosen.empty()) return unknown_gate(options.only);
  if (options.list) {
    for (const verify::Gate& gate : chosen) fmt::print("{:<16} {}\n", gate.name, gate.what);
    return 0;
  }
  const bool progress = isatty(STDERR_FILENO);
  const auto start = std::chrono::steady_clock::now();
  std::vector<GateResult> results;
  if (!options.json) fmt::print("{}\n", table_heading());
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    if (progress) fmt::print(stderr, "\r[{}/{}] {:<60}\r", i + 1, chosen.size(), chosen[i].what);
    for (const GateResult& result : verify::run(chosen[i], options.only, options.quick)) {
      results.push_back(result);
      if (!options.json) {
        fmt::print("{}\n", table_line(result));
        std::fflush(stdout);
      }
    }
  }
  if (results.empty()) return unknown_gate(options.only);
  if (progress) fmt::print(stderr, "{:<80}\r", "");
  if (options.json) {
    fmt::print("{}\n", to_json(results));
  } else {
    const auto passed = std::count_if(results.begin(), results.end(), [](const GateResult& r) { return r.pass(); });
    fmt::print("{} of {} pass, in {:.1f} s\n", passed, results.size(),
               std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return all_pass(results) ? 0 : 1;
}

}  // namespace ostium
