#include <time.h>

#include <algorithm>
#include <numeric>

#include "app/verify/gate.h"
#include "app/verify/steel_wire.h"
#include "tests/bench/rows.h"

namespace ostium::bench {

namespace {

double thread_cpu_ms() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

/// Times of single ticks of a swinging rod.
std::vector<double> swing_ticks(int elements, const Duration& duration) {
  verify::Bench bench = verify::steel_bench({.elements = elements});
  std::vector<double> ticks;
  ticks.reserve(duration.steps);
  std::uint64_t hashes = 0;
  for (int i = 0; i < duration.warm_up_steps + duration.steps; ++i) {
    const double start = thread_cpu_ms();
    bench.step();
    hashes ^= hash(bench.state);
    const double end = thread_cpu_ms();
    if (i >= duration.warm_up_steps) ticks.push_back(end - start);
  }
  volatile std::uint64_t keep = hashes;
  (void)keep;
  return ticks;
}

double mean(const std::vector<double>& x) {
  return std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
}

double percentile(std::vector<double> x, double fraction) {
  const auto nth = x.begin() + static_cast<std::ptrdiff_t>(fraction * static_cast<double>(x.size() - 1));
  std::nth_element(x.begin(), nth, x.end());
  return *nth;
}

}  // namespace

Row free_rod(const std::string& name, int elements, const Duration& duration) {
  Row row;
  row.name = name;
  const std::vector<double> ticks = swing_ticks(elements, duration);
  row.ms = mean(ticks);
  row.p999_ms = percentile(ticks, 0.999);
  const GateResult gate = verify::swing_tip(elements);
  row.gate = {gate.gate, gate.value, gate.pass()};
  return row;
}

std::vector<GrowthPoint> growth(const Duration& duration) {
  std::vector<GrowthPoint> out;
  for (int elements = 16; elements <= 4096; elements *= 2)
    out.push_back({elements, mean(swing_ticks(elements, duration))});
  return out;
}

}  // namespace ostium::bench
