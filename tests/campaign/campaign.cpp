/// ostium-campaign: how often `ostium explain` is right on sets with an undeclared effect.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <thread>

#include "tests/support/sets/judged.h"
#include "tests/support/sets/undeclared.h"

namespace {

using ostium::synthetic::Judged;
using Json = nlohmann::ordered_json;

struct Options {
  std::string file = "campaign.jsonl";
  std::vector<std::string> kinds, only;
  unsigned first_seed = 1;
  int seeds = 10, clean = 40, threads = 0;
  std::string sets;  ///< write the sets to this folder, and do nothing else
};

Json line_of(const Judged& j) {
  return {{"kind", j.kind},
          {"seed", j.seed},
          {"said", j.said},
          {"right", j.right},
          {"size", j.size},
          {"after", j.after},
          {"chi2_before", j.chi2_before},
          {"chi2_after", j.chi2_after},
          {"parameters", j.parameters},
          {"within", j.within},
          {"law_points", j.law_points},
          {"law_reached", j.law_reached},
          {"law_within", j.law_within},
          {"law_half_width", j.law_half_width},
          {"law_widest", j.law_widest},
          {"cpu_s", j.cpu_s}};
}

Judged judged_of(const Json& line) {
  Judged j;
  j.kind = line.at("kind"), j.seed = line.at("seed");
  j.said = line.at("said"), j.right = line.at("right"), j.size = line.at("size"), j.after = line.at("after");
  j.chi2_before = line.at("chi2_before"), j.chi2_after = line.at("chi2_after");
  j.parameters = line.at("parameters"), j.within = line.at("within"), j.cpu_s = line.at("cpu_s");
  return j;
}

/// Reads the results of an interrupted campaign; the last line may be incomplete.
std::vector<Judged> read(const std::string& file) {
  std::vector<Judged> out;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) try {
      out.push_back(judged_of(Json::parse(line)));
    } catch (const Json::exception&) {
    }
  return out;
}

/// ", law within its band at 38 of 41 points that the data reach (of 61), half the band 6 % (9 %)"
std::string of_law(const Judged& j) {
  if (j.law_points == 0) return "";
  return fmt::format(
      ", law within its band at {} of {} points that the data reach (of {}), half the band {:.0f} % ({:.0f} %), held "
      "out {:.2f}",
      j.law_within, j.law_reached, j.law_points, 100 * j.law_half_width, 100 * j.law_widest, j.after);
}

void print(const std::vector<Judged>& all) {
  std::map<std::string, std::map<std::string, int>> table;
  for (const Judged& j : all) ++table[j.kind][j.said];
  fmt::print("{:<28} {:>7} {:>7} {:>7} {:>6}  {}\n", "what was in it", "right", "size", "after", "cpu s",
             "what was said");
  int strong = 0, strong_right = 0, clean = 0, clean_right = 0, numbers = 0, within = 0, ended = 0, at_floor = 0;
  for (const std::string& kind : ostium::synthetic::undeclared_kinds()) {
    int n = 0, right = 0;
    double size = 0, after = 0, cpu = 0;
    for (const Judged& j : all) {
      if (j.kind != kind) continue;
      ++n, right += j.right, size += j.size, after += j.after, cpu = std::max(cpu, j.cpu_s);
      if (kind.ends_with("clean"))
        ++clean, clean_right += j.right;
      else if (j.size > 2)
        ++strong, strong_right += j.right;
      numbers += j.parameters, within += j.within;
      if (j.right && kind.rfind("out:", 0) != 0) ++ended, at_floor += j.after < 1.2;
    }
    if (n == 0) continue;
    std::string said;
    for (const auto& [what, count] : table[kind]) said += fmt::format("{}{} {}", said.empty() ? "" : ", ", count, what);
    fmt::print("{:<28} {:>3}/{:<3} {:>7.1f} {:>7.2f} {:>6.0f}  {}\n", kind, right, n, size / n, after / n, cpu, said);
  }
  const auto percent = [](int a, int b) { return b > 0 ? 100.0 * a / b : 0.0; };
  fmt::print("\neffect above twice the noise: right in {} of {} ({:.1f} %)\n", strong_right, strong,
             percent(strong_right, strong));
  fmt::print("clean: no effect found in {} of {} ({:.1f} %)\n", clean_right, clean, percent(clean_right, clean));
  fmt::print("true parameters within three standard errors: {} of {} ({:.1f} %)\n", within, numbers,
             percent(within, numbers));
  fmt::print("held-out error after within 20 % of the noise floor: {} of {} ({:.1f} %)\n", at_floor, ended,
             percent(at_floor, ended));
}

int write_sets(const Options& o) {
  for (const std::string& kind : ostium::synthetic::undeclared_kinds()) {
    if (!o.kinds.empty() && std::find(o.kinds.begin(), o.kinds.end(), kind) == o.kinds.end()) continue;
    for (int s = 0; s < (kind == "clean" ? o.clean : o.seeds); ++s) {
      const unsigned seed = o.first_seed + static_cast<unsigned>(s);
      std::string name = kind;
      std::replace(name.begin(), name.end(), ':', '-');
      try {
        fmt::print("{}\n", ostium::synthetic::write_set(fmt::format("{}/{}-{}", o.sets, name, seed),
                                                        ostium::synthetic::undeclared_set(kind, seed).set));
      } catch (const std::runtime_error& error) {
        fmt::print(stderr, "{} {}: {}\n", kind, seed, error.what());
      }
    }
  }
  return 0;
}

int run(const Options& o) {
  if (!o.sets.empty()) return write_sets(o);
  std::vector<Judged> all = read(o.file);
  std::vector<std::pair<std::string, unsigned>> left;
  for (const std::string& kind : ostium::synthetic::undeclared_kinds()) {
    if (!o.kinds.empty() && std::find(o.kinds.begin(), o.kinds.end(), kind) == o.kinds.end()) continue;
    for (int s = 0; s < (kind == "clean" ? o.clean : o.seeds); ++s) {
      const unsigned seed = o.first_seed + static_cast<unsigned>(s);
      const bool done =
          std::any_of(all.begin(), all.end(), [&](const Judged& j) { return j.kind == kind && j.seed == seed; });
      if (!done) left.emplace_back(kind, seed);
    }
  }
  std::ofstream out(o.file, std::ios::app);
  if (!out) throw std::runtime_error(o.file + " cannot be written");
  std::mutex mutex;
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < left.size(); i = next++) {
      Judged judged;
      try {
        judged = ostium::synthetic::judge(left[i].first, left[i].second, 1, o.only);
      } catch (const std::runtime_error& error) {
        const std::lock_guard lock(mutex);
        fmt::print(stderr, "{} {}: {}\n", left[i].first, left[i].second, error.what());
        continue;
      }
      const std::lock_guard lock(mutex);
      out << line_of(judged).dump() << std::endl;
      all.push_back(judged);
      fmt::print(stderr, "{} of {}: {} {} -> {}{}{} ({:.0f} s)\n", all.size(), all.size() + left.size() - i - 1,
                 judged.kind, judged.seed, judged.said, judged.right ? "" : "  WRONG", of_law(judged), judged.cpu_s);
    }
  };
  {
    const int threads = o.threads > 0 ? o.threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    std::vector<std::jthread> helpers;
    for (int t = 1; t < threads; ++t) helpers.emplace_back(work);
    work();
  }
  print(all);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Makes measured sets with an undeclared effect, has them explained, and counts what is right.");
  Options o;
  app.add_option("-o,--out", o.file, "Results, a line of JSON each; what is in it is not done again")
      ->capture_default_str();
  app.add_option("--kinds", o.kinds, "Only these")->delimiter(',');
  app.add_option("--try", o.only, "These effects together, instead of all; for law:bending, say")->delimiter(',');
  app.add_option("--seeds", o.seeds, "Sets of each kind")->capture_default_str();
  app.add_option("--clean", o.clean, "Sets without an effect")->capture_default_str();
  app.add_option("--first-seed", o.first_seed, "Where the seeds begin")->capture_default_str();
  app.add_option("--write", o.sets, "Write the sets here, and explain none")->type_name("DIR");
  app.add_option("--threads", o.threads, "Sets at a time; 0: one for each core")->capture_default_str();
  app.footer(
      "Examples:\n  ostium-campaign -o campaign.jsonl\n  ostium-campaign --kinds clean,roll_loss --seeds 3 --clean 3\n"
      "  ostium-campaign --kinds roll_loss --seeds 1 --write sets");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    return run(o);
  } catch (const std::exception& error) {
    fmt::print(stderr, "ostium-campaign: {}\n", error.what());
    return 3;
  }
}
