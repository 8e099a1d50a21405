#include <algorithm>
#include <numeric>

#include "app/gates/gate.h"
#include "app/gates/nesting.h"
#include "core/rod/initial_state.h"
#include "core/samples/steel_wire.h"
#include "tests/bench/rows.h"

namespace ostium::bench {

namespace {

/// Times of single ticks; `tick` returns the state's hash.
template <class Tick>
std::vector<double> ticks(const Duration& duration, Tick&& tick) {
  std::vector<double> times;
  times.reserve(duration.steps);
  std::uint64_t hashes = 0;
  for (int i = 0; i < duration.warm_up_steps + duration.steps; ++i) {
    const double start = thread_cpu_ms();
    hashes ^= tick();
    const double end = thread_cpu_ms();
    if (i >= duration.warm_up_steps) times.push_back(end - start);
  }
  volatile std::uint64_t keep = hashes;
  (void)keep;
  return times;
}

/// Tick times of a swinging rod.
std::vector<double> swing_ticks(int elements, const Duration& duration) {
  core::Bench bench = core::steel_bench({.elements = elements});
  return ticks(duration, [&] {
    bench.step();
    return hash(bench.state);
  });
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
  const std::vector<double> times = swing_ticks(elements, duration);
  row.ms = mean(times);
  row.p999_ms = percentile(times, 0.999);
  const data::GateResult gate = app::gates::swing_tip(elements);
  row.gate = {gate.gate, gate.value, gate.unit, gate.pass()};
  return row;
}

namespace {

core::Model nested(int rods, int elements) {
  struct Tube {
    double length_m, EI_N_m2, radius_m, bore_m, kg_per_m;
  };
  const std::vector<Tube> tubes = {
      {0.95, 4e-3, 1.2e-3, 1.0e-3, 6e-3}, {1.0, 2e-3, 0.9e-3, 0.65e-3, 4e-3}, {1.05, 1.5e-3, 0.45e-3, 0, 3e-3}};
  core::Model model;
  std::vector<int> all;
  for (std::size_t i = tubes.size() - rods; i < tubes.size(); ++i) {
    const Tube& t = tubes[i];
    core::RodDescription d;
    d.name = "tube";
    d.sections = {{.to_tip_m = t.length_m,
                   .EI1_N_m2 = t.EI_N_m2,
                   .EI2_N_m2 = t.EI_N_m2,
                   .GJ_N_m2 = t.EI_N_m2 / 1.3,
                   .kg_per_m = t.kg_per_m,
                   .radius_m = t.radius_m,
                   .inner_radius_m = t.bore_m,
                   .bending = {}}};
    d.element_lengths_m = equal_elements(d.sections, elements);
    d.damping = {0.007, 0.0035, 1e-3};
    all.push_back(static_cast<int>(model.rods.size()));
    model.rods.push_back(core::make_rod(d));
  }
  model.nestings = core::coaxial(all);
  return model;
}

}  // namespace

std::vector<Row> nested_rods(const Duration& duration) {
  struct Nested {
    core::Model model;
    core::State state;
    core::Scratch scratch;
    core::StepReport report;
    core::Inputs inputs;
    std::vector<double> times;

    explicit Nested(int rods)
        : model(nested(rods, 512)),
          state(make_state(model, std::vector<core::EndState>(rods, core::along_x()))),
          scratch(model) {
      inputs.rods.resize(rods);
    }
    void run(const Duration& some) {
      const std::vector<double> more = ticks(some, [&] {
        step(model, inputs, state, scratch, report);
        return hash(state);
      });
      times.insert(times.end(), more.begin(), more.end());
    }
    Row row(const std::string& name, const data::GateResult& gate) const {
      Row out;
      out.name = name, out.ms = mean(times), out.p999_ms = percentile(times, 0.999);
      out.gate = {gate.gate, gate.value, gate.unit, gate.pass()};
      return out;
    }
  };
  Nested pair(2), three(3);
  // Alternates, so that background load affects both equally.
  constexpr int turn = 100;
  for (int done = 0; done < duration.steps; done += turn)
    for (Nested* n : {&pair, &three}) n->run({done == 0 ? duration.warm_up_steps : 0, turn});
  const data::GateResult gate = app::gates::nesting_pair();
  return {pair.row("pair-2x512-free", gate), three.row("three-3x512-free", gate)};
}

std::vector<GrowthPoint> growth(const Duration& duration) {
  std::vector<GrowthPoint> out;
  for (int elements = 16; elements <= 4096; elements *= 2)
    out.push_back({elements, mean(swing_ticks(elements, duration))});
  return out;
}

}  // namespace ostium::bench
