#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/samples/steel_wire.h"
#include "tests/bench/corde.h"
#include "tests/bench/rows.h"

namespace ostium::bench {

namespace {

/// Largest change of length, percent, of our rod at real stiffness over 3 s of swinging from the horizontal.
double our_stretch_percent(int elements, double step_s) {
  core::Bench bench = core::steel_bench({.elements = elements});
  bench.model.step_s = step_s;
  double worst = 0;
  for (int i = 0; i < static_cast<int>(3 / step_s); ++i) {
    bench.step();
    double length = 0;
    for (int j = 0; j < elements; ++j) length += (bench.rod().position[j + 1] - bench.rod().position[j]).norm();
    worst = std::max(worst, std::fabs(length - 1));
  }
  return 100 * worst;
}

}  // namespace

void print_stretch_table(bool quick) {
  struct Method {
    const char* name;
    Stretch kind;
    int sweeps;
  };
  const Method methods[] = {{"1G", Stretch::global, 1},  {"1L", Stretch::local, 1},   {"5L", Stretch::local, 5},
                            {"10L", Stretch::local, 10}, {"50L", Stretch::local, 50}, {"1I", Stretch::penalty, 1}};
  fmt::print(
      "largest stretch of a swinging rod, % (thesis, figure 3.6): the yardstick with a soft rod, one global (1G), "
      "local\n"
      "(nL) or penalty (1I) distance solve a step; ours at real stiffness (60 GPa, 1 m), one implicit solve a step\n");
  fmt::print("{:>8} {:>9}", "step ms", "elements");
  for (const Method& m : methods) fmt::print(" {:>9}", m.name);
  fmt::print(" {:>9}\n", "ours");
  for (double step_ms : {1.0, 2.5, 5.0}) {
    for (int elements : {128, 256, 512, 1024}) {
      if (quick && elements > 256) continue;
      fmt::print("{:>8} {:>9}", step_ms, elements);
      for (const Method& m : methods) {
        const CordeSettings soft = soft_rod(elements, step_ms * 1e-3, m.kind, m.sweeps);
        fmt::print(" {:>9.2g}", stretch_percent(soft, swing_s(soft)));
        std::fflush(stdout);
      }
      fmt::print(" {:>9.2g}\n", our_stretch_percent(elements, step_ms * 1e-3));
    }
  }
}

}  // namespace ostium::bench
