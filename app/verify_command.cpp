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

void print_list(const std::vector<verify::Gate>& chosen, bool json) {
  if (json) {
    std::vector<std::pair<std::string, std::string>> names;
    for (const verify::Gate& gate : chosen) names.emplace_back(gate.name, gate.what);
    fmt::print("{}\n", names_to_json(names));
  } else {
    for (const verify::Gate& gate : chosen) fmt::print("{:<16} {}\n", gate.name, gate.what);
  }
}

/// A result that could not be written is not one.
int with_output_checked(int code) {
  if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return code;
  fmt::print(stderr, "ostium verify: the results could not be written; is the disk full, or the pipe closed?\n");
  return 1;
}

}  // namespace

int verify_command(const VerifyOptions& options) {
  const auto chosen = verify::selected(options.only);
  if (chosen.empty()) return unknown_gate(options.only);
  if (options.list) {
    print_list(chosen, options.json);
    return with_output_checked(0);
  }
  const bool progress = isatty(STDERR_FILENO);
  const auto start = std::chrono::steady_clock::now();
  std::vector<GateResult> results;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    if (progress) fmt::print(stderr, "[{}/{}] {}\r", i + 1, chosen.size(), chosen[i].what);
    const auto found = verify::run(chosen[i], options.only, options.quick);
    if (progress) fmt::print(stderr, "{:<90}\r", "");
    if (!options.json && results.empty() && !found.empty()) fmt::print("{}\n", table_heading());
    for (const GateResult& result : found) {
      results.push_back(result);
      if (!options.json) fmt::print("{}\n", table_line(result));
    }
    std::fflush(stdout);
  }
  if (results.empty()) return unknown_gate(options.only);
  if (options.json) {
    fmt::print("{}\n", to_json(results));
  } else {
    const auto passed = std::count_if(results.begin(), results.end(), [](const GateResult& r) { return r.pass(); });
    fmt::print("{} of {} pass, in {:.1f} s\n", passed, results.size(),
               std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return with_output_checked(all_pass(results) ? 0 : 1);
}

}  // namespace ostium
