#include "tests/bench/procedure_rows.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <numeric>

#include "app/session/run/play.h"
#include "app/session/run/replay.h"

namespace ostium::bench {

namespace {

namespace fs = std::filesystem;

constexpr double deepest_scripted_m = 0.05e-3;  // allowed by the gates

/// Ticks of the time stamp counter in a millisecond, measured over the first replay.
struct Pace {
  double clock_ms = 0;
  std::uint64_t ticks = 0;
  double ms(std::uint64_t of) const { return clock_ms * static_cast<double>(of) / static_cast<double>(ticks); }
};

double wall_ms() {
  timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

/// One replay; steps that took less time than before replace their times.
void replay_once(const std::string& recording, const ProfileOptions& options, bool first, StepCosts& costs) {
  app::Replay replay(recording);
  replay.go_to(options.from_s);
  if (options.from_s > 0) replay.tick();  // the whole wall is placed anew after a jump
  core::PhaseClock clock;
  replay.count_time(&clock);
  const std::uint64_t until =
      options.seconds > 0
          ? replay.state.rods.step + static_cast<std::uint64_t>(options.seconds / replay.recording.step_s())
          : replay.recording.steps();
  const Pace begin{wall_ms(), __rdtsc()};
  std::vector<std::array<std::uint64_t, core::PhaseClock::most_phases>> ticks;
  std::vector<double> ms;
  while (replay.state.rods.step < until) {
    clock.ticks = {};
    const double start = thread_cpu_ms();
    if (!replay.tick()) break;
    ms.push_back(thread_cpu_ms() - start);
    ticks.push_back(clock.ticks);
    costs.same = costs.same && replay.same;
    if (first)
      costs.steps.push_back({1e9F,
                             {},
                             replay.report.rods.counts,
                             static_cast<float>(1e3 * replay.report.rods.deepest_m),
                             replay.report.rods.trouble});
  }
  const Pace pace{wall_ms() - begin.clock_ms, __rdtsc() - begin.ticks};
  for (std::size_t n = 0; n < ms.size(); ++n) {
    StepCosts::Step& step = costs.steps[n];
    if (ms[n] >= step.ms) continue;
    step.ms = static_cast<float>(ms[n]);
    step.phases_ms.clear();
    for (int p = 0; p < app::session_phases; ++p)
      step.phases_ms.push_back(static_cast<float>(pace.ms(ticks[n][static_cast<std::size_t>(p)])));
  }
}

/// Steps by time, the slowest last.
std::vector<const StepCosts::Step*> by_time(const StepCosts& costs) {
  std::vector<const StepCosts::Step*> sorted;
  for (const StepCosts::Step& step : costs.steps) sorted.push_back(&step);
  std::sort(sorted.begin(), sorted.end(), [](auto* a, auto* b) { return a->ms < b->ms; });
  return sorted;
}

double mean_ms(std::span<const StepCosts::Step* const> steps) {
  double sum = 0;
  for (const auto* step : steps) sum += step->ms;
  return steps.empty() ? 0 : sum / static_cast<double>(steps.size());
}

/// The slowest steps: when, and what took the time.
void print_slowest(const StepCosts& costs, std::span<const StepCosts::Step* const> sorted) {
  fmt::print("\n{:>10} {:>9}  {:<22} {:>10} {:>7} {:>6} {:>9} {:>9}\n", "slowest, s", "ms", "most of it in",
             "iterations", "changes", "flips", "clusters", "halvings");
  constexpr std::size_t shown = 12;
  for (std::size_t n = 0; n < std::min(shown, sorted.size()); ++n) {
    const StepCosts::Step& step = *sorted[sorted.size() - 1 - n];
    const auto most = std::max_element(step.phases_ms.begin(), step.phases_ms.end());
    fmt::print("{:>10.3f} {:>9.3f}  {:<22} {:>10} {:>7} {:>6} {:>9} {:>9}\n",
               1e-3 * static_cast<double>(&step - costs.steps.data() + 1), step.ms,
               fmt::format("{} {:.2f}", app::phase_name(static_cast<int>(most - step.phases_ms.begin())), *most),
               step.counts.iterations, step.counts.changes, step.counts.flips, step.counts.clusters,
               step.counts.halvings);
  }
}

double share(const std::vector<const StepCosts::Step*>& sorted, double of) {
  return sorted.empty() ? 0 : sorted[static_cast<std::size_t>(of * static_cast<double>(sorted.size() - 1))]->ms;
}

}  // namespace

StepCosts profile(const std::string& recording, const ProfileOptions& options) {
  StepCosts costs;
  for (int n = 0; n < options.replays; ++n) {
    fmt::print(stderr, "replay {} of {} ...\n", n + 1, options.replays);
    replay_once(recording, options, n == 0, costs);
  }
  return costs;
}

void print_profile(const StepCosts& costs) {
  const std::vector<const StepCosts::Step*> sorted = by_time(costs);
  if (sorted.empty()) return;
  const std::size_t slow_from = sorted.size() - std::max<std::size_t>(1, sorted.size() / 1000);
  const std::span<const StepCosts::Step*const> all(sorted), slow = all.subspan(slow_from);
  fmt::print("{} steps, {}\n", sorted.size(), costs.same ? "each as recorded" : "NOT as recorded");
  fmt::print("ms of CPU: mean {:.4f}, median {:.4f}, 99 % {:.3f}, 99.9 % {:.3f}, most {:.3f}\n\n", mean_ms(all),
             share(sorted, 0.5), share(sorted, 0.99), share(sorted, 0.999), sorted.back()->ms);
  fmt::print("{:<20} {:>9} {:>7} {:>14}\n", "phase", "mean ms", "share", "of slowest");
  // Phases are timed by the clock on the wall, steps by the processor: shares are of the sum of phases.
  const auto mean_of = [](std::span<const StepCosts::Step* const> steps, int phase) {
    double ms = 0;
    for (const auto* step : steps) ms += step->phases_ms[static_cast<std::size_t>(phase)];
    return ms / static_cast<double>(steps.size());
  };
  double sum_all = 0, sum_slow = 0;
  for (int p = 0; p < app::session_phases; ++p) sum_all += mean_of(all, p), sum_slow += mean_of(slow, p);
  for (int p = 0; p < app::session_phases; ++p)
    fmt::print("{:<20} {:>9.4f} {:>5.1f} % {:>12.1f} %\n", app::phase_name(p), mean_of(all, p),
               100 * mean_of(all, p) / sum_all, 100 * mean_of(slow, p) / sum_slow);
  const auto deepest = std::max_element(costs.steps.begin(), costs.steps.end(),
                                        [](const auto& a, const auto& b) { return a.deepest_mm < b.deepest_mm; });
  fmt::print("\ndeepest in a wall, at most: {:.4f} mm, {:.3f} s from where this begins; {} steps in trouble\n",
             deepest->deepest_mm, 1e-3 * static_cast<double>(deepest - costs.steps.begin() + 1),
             std::count_if(costs.steps.begin(), costs.steps.end(), [](const auto& step) {
               return (step.trouble & ~static_cast<std::uint32_t>(core::feed_stopped)) != 0;
             }));
  fmt::print("\n{:<20} {:>9} {:>7} {:>14} {:>12}\n", "count a step", "mean", "most", "mean of slow", "steps with");
  const auto row = [&](const char* name, auto&& of) {
    double sum = 0, of_slow = 0;
    int most = 0;
    long any = 0;
    for (const auto* step : all) sum += of(*step), most = std::max(most, of(*step)), any += of(*step) > 0;
    for (const auto* step : slow) of_slow += of(*step);
    fmt::print("{:<20} {:>9.3f} {:>7} {:>14.1f} {:>12}\n", name, sum / static_cast<double>(all.size()), most,
               of_slow / static_cast<double>(slow.size()), any);
  };
  using Step = StepCosts::Step;
  row("iterations", [](const Step& s) { return s.counts.iterations; });
  row("solves", [](const Step& s) { return s.counts.solves; });
  row("elements eliminated", [](const Step& s) { return s.counts.eliminated; });
  row("changes of ties", [](const Step& s) { return s.counts.changes; });
  row("ties flipped", [](const Step& s) { return s.counts.flips; });
  row("clusters posed", [](const Step& s) { return s.counts.clusters; });
  row("halvings", [](const Step& s) { return s.counts.halvings; });
  row("retries from rest", [](const Step& s) { return s.counts.retries; });
  print_slowest(costs, all);
}

Row procedure_row(const std::string& vessel, const std::string& script, const ProfileOptions& options) {
  app::RunSetup setup;
  set_vessel(vessel, {}, setup);
  set_script(data::find_script(script), setup);
  std::string warnings;
  const auto built = make_vessel(setup, warnings);
  choose_sizes(*built, setup);
  app::ScriptedRun run(setup, built);
  const fs::path file = fs::temp_directory_path() / fmt::format("ostium-bench-{}.h5", ::getpid());
  app::PlayOptions play_options;
  play_options.recorder.mode = app::RecordMode::events;
  play_options.recorder.file = file.string();
  const app::PlayReport report = play(run, setup, play_options);
  const StepCosts own = profile(file.string(), options);
  fs::remove(file);
  const std::vector<const StepCosts::Step*> sorted = by_time(own);
  Row row;
  row.name = script;
  row.ms = mean_ms(sorted), row.p999_ms = share(sorted, 0.999), row.most_ms = share(sorted, 1);
  const double deepest_mm = 1e3 * report.penetration.deepest_m;
  row.gate = {report.outcome + ", in walls", deepest_mm, "mm",
              own.same && report.outcome == "success" && report.penetration.outside == 0 &&
                  deepest_mm < 1e3 * deepest_scripted_m};
  return row;
}

}  // namespace ostium::bench
