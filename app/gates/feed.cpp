/// A wire fed a metre in and out through its introducer returns to the same rest state without friction; and entering
/// elements do not show in the push force.
#include <algorithm>
#include <cmath>

#include "app/gates/gate.h"
#include "core/rod/energy.h"
#include "core/rod/initial_state.h"
#include "core/samples/steel_wire.h"

namespace ostium::app::gates {

namespace {

constexpr double start_m = 0.1, feed_m_s = 0.05;

/// 1.2 m of slightly curved wire in 2 mm elements, the first 10 cm inside, in a fluid that damps it to rest.
core::Bench introducer(double curvature_per_m) {
  core::RodDescription wire = core::steel_wire({.elements = 600, .length_m = 1.2});
  wire.sections[0].rest_curvature_per_m = Eigen::Vector3d(0, curvature_per_m, 0);
  wire.damping.drag_across_N_s_m2 = wire.damping.drag_along_N_s_m2 = 0.05;
  core::Bench bench = bench_of(wire);
  bench.state = make_state(bench.model, {core::along_x()}, {start_m});
  bench.settle();
  return bench;
}

void run(core::Bench& bench, double feed_m_s, double seconds) {
  bench.inputs.rods[0].feed_m_s = feed_m_s;
  for (int i = 0; i < static_cast<int>(std::lround(1000 * seconds)); ++i) bench.step();
}

}  // namespace

std::vector<data::GateResult> feed_round_trips(int trips, double length_m) {
  core::Bench bench = introducer(0.5);
  const core::RodState before = bench.rod();
  const double energy_before = energy(bench.model, bench.inputs, bench.state, 0).total_J();
  for (int trip = 0; trip < trips; ++trip) {
    run(bench, feed_m_s, length_m / feed_m_s);
    run(bench, -feed_m_s, length_m / feed_m_s);
  }
  run(bench, 0, 4);

  double shape = 0;
  for (int i = before.first + 1; i <= bench.model.rods[0].elements; ++i)
    shape = std::max(shape, (bench.rod().position[i] - before.position[i]).norm());
  const double energy_after = energy(bench.model, bench.inputs, bench.state, 0).total_J();
  return {{"feed-round-trip-shape", shape / start_m, 0, 1e-6, "1"},
          {"feed-round-trip-energy", std::fabs(energy_after / energy_before - 1), 0, 1e-6, "1"}};
}

/// While a curved wire (radius 100 mm) is fed, an entering element may change the push only by a negligible part of the
/// push from bending, EI k^2 / 2.
data::GateResult feed_ripple() {
  const double curvature = 10;
  core::Bench bench = introducer(curvature);
  const double scale_N = 0.5 * stiffness_at_rest(bench.model.rods[0], 1)[0] * curvature * curvature;
  double last = 0, before_last = 0, worst = 0;
  bench.inputs.rods[0].feed_m_s = feed_m_s;
  for (int ms = 0; ms < 2000; ++ms) {
    bench.step();
    const double push = bench.report.rods[0].push_N;
    if (ms > 200) worst = std::max(worst, std::fabs(push - 2 * last + before_last));  // zero for a smooth push
    before_last = last, last = push;
  }
  return {"feed-ripple", worst / scale_N, 0, 5e-3, "1"};
}

std::vector<data::GateResult> feed(bool quick) {
  std::vector<data::GateResult> out = feed_round_trips(quick ? 1 : 3, quick ? 0.2 : 1.0);
  out.push_back(feed_ripple());
  return out;
}

}  // namespace ostium::app::gates
