/// Sweeping a boundary between a soft and a stiff section through one element in small steps moves the tip smoothly.
/// Reference: the planar elastica with piecewise stiffness, EI(s) theta' = M, M' = -w (L - s) cos(theta), M(L) = 0,
/// solved as a boundary-value problem by shooting with Runge-Kutta steps that end on the boundary.
#include <algorithm>
#include <cmath>

#include "app/gates/gate.h"
#include "core/samples/steel_wire.h"

namespace ostium::app::gates {

namespace {

struct Cantilever {
  double length, boundary;         // m; the boundary measured from the base
  double EI_base, EI_tip;          // N m2
  double weight_base, weight_tip;  // N/m

  double load_beyond(double s) const {  // of everything distal to s
    return weight_tip * (length - std::max(s, boundary)) + weight_base * std::max(boundary - s, 0.0);
  }
};

struct Shot {
  double x = 0, drop = 0, theta = 0, moment = 0;  // theta: downwards from horizontal
};

Shot shoot(const Cantilever& c, double moment_at_base) {
  Shot y{0, 0, 0, moment_at_base};
  const auto integrate = [&](double from, double to, double EI) {
    constexpr int steps = 2000;
    const double h = (to - from) / steps;
    const auto slope = [&](double s, const Shot& q) {
      return Shot{std::cos(q.theta), std::sin(q.theta), q.moment / EI, -c.load_beyond(s) * std::cos(q.theta)};
    };
    const auto along = [](const Shot& q, const Shot& k, double by) {
      return Shot{q.x + by * k.x, q.drop + by * k.drop, q.theta + by * k.theta, q.moment + by * k.moment};
    };
    for (int i = 0; i < steps; ++i) {
      const double s = from + i * h;
      const Shot k1 = slope(s, y), k2 = slope(s + h / 2, along(y, k1, h / 2)),
                 k3 = slope(s + h / 2, along(y, k2, h / 2)), k4 = slope(s + h, along(y, k3, h));
      y = along(along(along(along(y, k1, h / 6), k2, h / 3), k3, h / 3), k4, h / 6);
    }
  };
  integrate(0, c.boundary, c.EI_base);
  integrate(c.boundary, c.length, c.EI_tip);
  return y;
}

Shot solve(const Cantilever& c) {
  double low = 0, high = c.load_beyond(0) * c.length;  // the moment at the tip grows with the one at the base
  for (int i = 0; i < 80; ++i) {
    const double middle = 0.5 * (low + high);
    (shoot(c, middle).moment > 0 ? high : low) = middle;
  }
  return shoot(c, 0.5 * (low + high));
}

}  // namespace

std::vector<data::GateResult> rod_section(bool quick) {
  constexpr double length = 0.3, g = 9.81;
  constexpr int elements = 200, sweep = 8;
  double worst_mm = 0;
  for (int k = 0; k <= sweep; k += quick ? 4 : 1) {
    const double soft_m = 0.1 + length / elements * k / sweep;  // of the distal section, sweeping one whole element
    core::RodDescription wire;
    wire.name = "two sections";
    // A fifth of the diameter gives 1/625 of the stiffness: the joint at the boundary must not jump.
    wire.sections = {core::round_section(0, soft_m, 0.09e-3, 0, 60e9, 0.3, 6500),
                     core::round_section(soft_m, length, 0.45e-3, 0, 60e9, 0.3, 6500)};
    wire.element_lengths_m = equal_elements(wire.sections, elements);
    core::Bench bench = bench_of(wire);
    bench.settle();
    const core::Section &tip = wire.sections[0], &base = wire.sections[1];
    const Shot exact =
        solve({length, length - soft_m, base.EI1_N_m2, tip.EI1_N_m2, base.kg_per_m * g, tip.kg_per_m * g});
    worst_mm = std::max(worst_mm, 1e3 * (bench.tip() - Eigen::Vector3d(exact.x, 0, -exact.drop)).norm());
  }
  return {{"rod-section", worst_mm, 0, 0.02, "mm"}};
}

}  // namespace ostium::app::gates
