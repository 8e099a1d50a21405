#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>

#include "app/gates/drives.h"
#include "core/rod/energy.h"
#include "tests/bench/rows.h"

namespace ostium::bench {

namespace {

constexpr double beats_per_min = 75;
constexpr double procedure_m = 0.05e-3;  // allowed by the gate

/// Memory of the process, MiB.
double memory_MiB() {
  std::ifstream file("/proc/self/statm");
  long size = 0, resident = 0;
  file >> size >> resident;
  return static_cast<double>(resident) * 4096 / (1 << 20);
}

double kinetic_J(const app::gates::Rehearsal& run) {
  double sum = 0;
  for (std::size_t r = 0; r < run.model.rods.size(); ++r) sum += energy(run.model, run.inputs, run.state, r).kinetic_J;
  return sum;
}

}  // namespace

Row vessel_pair(const std::string& name, bool quick) {
  const app::gates::TestVessel vessel = app::gates::test_vessel();
  app::gates::Rehearsal run(vessel, true);
  core::PenetrationOracle truth(vessel.wall);
  app::gates::Holding holding;
  std::vector<double> times;
  const int steps = quick ? 2'000 : 24'000;
  for (int n = 0; n < steps; ++n) {
    app::gates::follow_script(1e-3 * n, run);
    const double start = thread_cpu_ms();
    run.step(beats_per_min);
    times.push_back(thread_cpu_ms() - start);
    if (n % 20 == 19) app::gates::judge(run, truth, false, holding);
  }
  Row row;
  row.name = name;
  row.ms = std::accumulate(times.begin(), times.end(), 0.0) / static_cast<double>(times.size());
  const auto nth = times.begin() + static_cast<std::ptrdiff_t>(0.999 * static_cast<double>(times.size() - 1));
  std::nth_element(times.begin(), nth, times.end());
  row.p999_ms = *nth, row.most_ms = *std::max_element(times.begin(), times.end());
  row.gate = {"contact-vessel-script", 1e3 * holding.deepest_m, "mm",
              holding.escapes == 0 && holding.deepest_m < procedure_m};
  return row;
}

bool print_drives(int count) {
  const app::gates::TestVessel vessel = app::gates::test_vessel();
  double deepest = 0;
  int escapes = 0, worst = 0;
  for (int seed = 0; seed < count; ++seed) {
    const app::gates::Holding holding = app::gates::random_drive(vessel, static_cast<std::uint64_t>(seed), 5);
    if (holding.deepest_m > deepest) deepest = holding.deepest_m, worst = seed;
    escapes += holding.escapes;
    if (holding.escapes > 0 || holding.deepest_m > deepest_drive_m || (seed + 1) % 10 == 0 || seed + 1 == count) {
      fmt::print("drive {:4}: {:.4f} mm, {} outside, {} steps in trouble; so far {:.4f} mm (drive {}), {} outside\n",
                 seed, 1e3 * holding.deepest_m, holding.escapes, holding.troubled, 1e3 * deepest, worst, escapes);
      std::fflush(stdout);
    }
  }
  return escapes == 0 && deepest < deepest_drive_m;
}

bool print_soak(double minutes) {
  const app::gates::TestVessel vessel = app::gates::test_vessel();
  app::gates::Rehearsal run(vessel, true);
  core::PenetrationOracle truth(vessel.wall);
  app::gates::Holding all;
  double first_MiB = 0;
  bool bounded = true;
  const long steps = std::lround(60e3 * minutes), row = minutes > 4 ? 60'000 : 15'000;
  for (long from = 0; from < steps; from += row) {
    app::gates::Holding holding;
    double energy_J = 0;
    for (long n = from; n < std::min(steps, from + row); ++n) {
      app::gates::follow_script(1e-3 * static_cast<double>(n), run);
      run.step(beats_per_min);
      energy_J = std::max(energy_J, kinetic_J(run));
      if (run.report.trouble & ~static_cast<unsigned>(core::feed_stopped)) ++holding.troubled;
      if (n % 20 == 19) app::gates::judge(run, truth, n % 2000 == 1999, holding);
    }
    if (from == 0) first_MiB = memory_MiB();
    fmt::print(
        "to {:6.2f} min: {:.4f} mm, {} outside, {} steps in trouble, kinetic energy up to {:.2g} mJ, {:.0f} MiB\n",
        1.0 / 60'000 * static_cast<double>(from + row), 1e3 * holding.deepest_m, holding.escapes, holding.troubled,
        1e3 * energy_J, memory_MiB());
    std::fflush(stdout);
    all.deepest_m = std::max(all.deepest_m, holding.deepest_m);
    all.escapes += holding.escapes;
    bounded = bounded && energy_J < 1;
  }
  return bounded && all.escapes == 0 && all.deepest_m < procedure_m && memory_MiB() < first_MiB + 8;
}

}  // namespace ostium::bench
