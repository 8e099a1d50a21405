/// Critical loads of straight or circular equilibria: the loads at which the simulator's linear system gets a direction
/// of negative stiffness, found by bisection. (A test of `core` checks that the step leaves the equilibrium there.)
#include <cmath>

#include "app/gates/gate.h"
#include "core/base/units.h"
#include "core/samples/steel_wire.h"

namespace ostium::app::gates {

namespace {

constexpr double bisect_to = 1e-4;

double bending_stiffness(const core::Rod& rod) { return stiffness_at_rest(rod, 1)[0]; }
double torsional_stiffness(const core::Rod& rod) { return stiffness_at_rest(rod, 1)[2]; }

}  // namespace

/// A cantilever pushed along its axis: P = pi^2 EI / 4 L^2 (Euler 1744).
std::vector<data::GateResult> rod_euler(bool) {
  core::Bench bench = core::steel_bench({.elements = 100, .gravity = false});
  const double euler_N = std::pow(units::pi / 2, 2) * bending_stiffness(bench.model.rods[0]);
  const double load_N = core::critical(0, 3 * euler_N, bisect_to, [&](double N) {
    bench.inputs.rods[0].tip_force_W_N = Eigen::Vector3d(-N, 0, 0);
    return bench.is_unstable();
  });
  return {{"rod-euler", load_N, euler_N, 0.01 * euler_N, "N"}};
}

/// Both ends clamped, the far one sliding along the axis, and twisted relative to each other: M L / EI = 8.987, the
/// first root of tan(x) = x, x = M L / 2 EI (Greenhill 1883).
std::vector<data::GateResult> rod_greenhill(bool) {
  constexpr int elements = 100;
  core::Bench bench = core::steel_bench({.elements = elements, .gravity = false});
  const core::Rod& rod = bench.model.rods[0];
  const double EI = bending_stiffness(rod), GJ = torsional_stiffness(rod);  // L = 1 m
  bench.inputs.rods[0].tip.hold = core::Hold::guided;
  const double moment = core::critical(0, 20, bisect_to, [&](double ML_over_EI) {
    const double twist_rad = ML_over_EI * EI / GJ;
    std::vector<Eigen::Vector4d> frames;
    for (int j = 0; j < elements; ++j)
      frames.push_back(
          core::turned_frame(core::along_x().q_W, Eigen::Vector3d(twist_rad * (j + 0.5) / elements, 0, 0)));
    lay_out(rod, frames, core::turned_frame(core::along_x().q_W, Eigen::Vector3d(twist_rad, 0, 0)), bench.rod());
    return bench.is_unstable();
  });
  return {{"rod-greenhill", moment, 8.987, 0.02 * 8.987, "1"}};
}

/// A naturally straight rod bent into a circle and closed with a twist: the planar circle is stable up to 2 pi sqrt(3)
/// EI / GJ (Michell 1889, Zajac 1962). Only the closing section holds the ring, which removes its rigid motions: a ring
/// in equilibrium needs no force there.
std::vector<data::GateResult> rod_ring(bool) {
  constexpr int elements = 128;
  core::Bench bench = core::steel_bench({.elements = elements, .gravity = false});
  const core::Rod& rod = bench.model.rods[0];
  const double reference_rad = 2 * units::pi * std::sqrt(3.0) * bending_stiffness(rod) / torsional_stiffness(rod);
  bench.inputs.rods[0].tip.hold = core::Hold::clamped;
  const double twist_rad = core::critical(0, 2 * reference_rad, bisect_to, [&](double rad) {
    lay_out_ring(rod, rad, bench.rod());
    return bench.is_unstable();
  });
  return {{"rod-ring", twist_rad, reference_rad, 0.02 * reference_rad, "rad"}};
}

}  // namespace ostium::app::gates
