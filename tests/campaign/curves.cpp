/// ostium-curves: how often `ostium explain` is right on sets of curves with something undeclared in them.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <fstream>
#include <map>
#include <thread>

#include "data/identification/curves/curve_explanation.h"
#include "tests/support/sets/bench_set.h"

namespace {

using namespace ostium;

struct Options {
  std::string kind, sets;
  std::vector<std::string> contents;
  std::vector<double> sizes = {3};
  unsigned first_seed = 1;
  int seeds = 10;
  bool verbose = false;
};

struct Said {
  std::string verdict, effects, line;
  std::string law;  ///< how well a learned law holds the truth; empty if there is none
  bool right = false, effect_named = false;
  double cpu_s = 0, before = 0, after = 0;
};

/// Points that the data reach, those whose band holds the truth, and half the band against the law.
std::string of_law(const data::LearnedLaw& law, const std::function<double(double)>& truth) {
  int reached = 0, within = 0;
  std::vector<double> widths;
  for (std::size_t i = 0; i < law.sigma.size(); ++i) {
    if (!law.reached(i)) continue;
    const Eigen::Vector2d p = law.curve.points[i];
    ++reached, within += std::fabs(p.y() - truth(p.x())) < data::band_sigmas * law.sigma[i];
    widths.push_back(data::band_sigmas * law.sigma[i] / p.y());
  }
  std::sort(widths.begin(), widths.end());
  if (widths.empty()) return "not reached";
  return fmt::format(
      "within its band at {} of {} points that the data reach (of {}), half the band {:.1f} % ({:.1f} %)", within,
      reached, law.sigma.size(), 100 * widths[widths.size() / 2], 100 * widths[widths.size() * 9 / 10]);
}

Said judged(const synthetic::BenchSet& set) {
  Said out;
  const auto start = std::chrono::steady_clock::now();
  const auto root = data::parse_json("set.json", set.json);
  const auto x = data::curves::explain_curves(root, {});
  out.cpu_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  out.verdict = to_string(x.verdict), out.before = x.declared.model.rms(), out.after = x.best().model.rms();
  const auto& named = x.found() ? x.best().effects : std::vector<std::string>{};
  for (const std::string& id : named) out.effects += (out.effects.empty() ? "" : "+") + id;
  out.effect_named = !named.empty();
  if (set.effects.empty())
    out.right = x.verdict == data::Verdict::explained;
  else
    out.right = x.found() && named == set.effects;
  // Two that the data cannot part, with the right one among them.
  if (x.verdict == data::Verdict::ambiguous)
    for (std::size_t k = 0; k < x.rivals; ++k) {
      out.effects += (k > 0 ? "/" : "");
      for (const std::string& id : x.candidates[k].effects) out.effects += id;
      if (x.candidates[k].effects == set.effects) out.right = true;
    }
  if (set.law && x.found() && !x.best().laws.empty())
    out.law = of_law(x.best().laws[0], set.law) + fmt::format(", held out {:.2f}", x.best().model.held_out.value_or(0));
  for (std::size_t k = 0; k < std::min<std::size_t>(3, x.candidates.size()); ++k) {
    const auto& c = x.candidates[k];
    out.line += fmt::format("\n      {} bic {:+.0f} chi2 {:.2f} slow {:.1f} noise {} edge {}", c.name,
                            c.bic() - x.declared.bic(), c.model.per_freedom(), c.slow_shapes, c.is_noise, c.at_an_edge);
  }
  return out;
}

int run(const Options& o) {
  for (const synthetic::BenchKind& kind : synthetic::bench_kinds()) {
    if (!o.kind.empty() && kind.name != o.kind) continue;
    fmt::print("{:<24} {:>5} {:>8} {:>7} {:>7} {:>7}  {}\n", kind.name, "size", "right", "before", "after", "s",
               "said");
    for (const std::string& content : kind.contents) {
      if (!o.contents.empty() && std::find(o.contents.begin(), o.contents.end(), content) == o.contents.end()) continue;
      const bool sized = content != "clean" && content.find(':') == std::string::npos;
      for (const double size : sized ? o.sizes : std::vector<double>{0}) {
        std::map<std::string, int> said;
        int right = 0;
        double before = 0, after = 0, longest = 0;
        for (int s = 0; s < o.seeds; ++s) {
          const unsigned seed = o.first_seed + static_cast<unsigned>(s);
          const synthetic::BenchSet set = kind.make(content, size, seed);
          if (!o.sets.empty())
            std::ofstream(fmt::format("{}/{}-{}-{}.json", o.sets, kind.name, content, seed)) << set.json;
          const Said j = judged(set);
          right += j.right, before += j.before, after += j.after, longest = std::max(longest, j.cpu_s);
          if (!j.law.empty()) fmt::print("   seed {}: {} {}: {}\n", seed, j.verdict, j.effects, j.law);
          ++said[j.verdict + (j.effects.empty() ? "" : " " + j.effects)];
          if (o.verbose && !j.right)
            fmt::print("   seed {}: {} {} ({:.2f}){}\n", seed, j.verdict, j.effects, j.before, j.line);
        }
        std::string words;
        for (const auto& [what, count] : said) words += fmt::format("{}{} {}", words.empty() ? "" : ", ", count, what);
        fmt::print("{:<24} {:>5} {:>4}/{:<3} {:>7.2f} {:>7.2f} {:>7.1f}  {}\n", content, size, right, o.seeds,
                   before / o.seeds, after / o.seeds, longest, words);
        std::fflush(stdout);
      }
    }
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  CLI::App app("How often ostium explain is right on sets of curves");
  app.add_option("kind", o.kind, "three_point_bend, ...; all if none is named");
  app.add_option("--content", o.contents, "Only these");
  app.add_option("--size", o.sizes, "Of what is undeclared, over the noise");
  app.add_option("--first-seed", o.first_seed, "");
  app.add_option("--seeds", o.seeds, "");
  app.add_option("--sets", o.sets, "Also write the sets to this folder");
  app.add_flag("--verbose", o.verbose, "Say what went wrong");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  return run(o);
}
