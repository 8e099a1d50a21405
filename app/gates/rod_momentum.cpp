/// A free unloaded rod conserves its momentum: linear for a bent one that springs open in flight, and angular for a
/// straight one spinning about its middle at one turn a second.
#include <Eigen/Geometry>
#include <algorithm>

#include "app/gates/gate.h"
#include "core/base/units.h"
#include "core/samples/steel_wire.h"

namespace ostium::app::gates {

namespace {

using Eigen::Vector3d;

core::Bench free_bench(int elements) {
  core::Bench bench = core::steel_bench({.elements = elements, .gravity = false});
  bench.inputs.rods[0].base.hold = core::Hold::free;
  return bench;
}

Vector3d linear_momentum(const core::Bench& bench) {
  Vector3d sum = Vector3d::Zero();
  for (int i = 0; i < bench.model.rods[0].nodes(); ++i)
    sum += bench.model.rods[0].mass.at(0)[i] * bench.state.rods[0].velocity[i];
  return sum;
}

Vector3d angular_momentum(const core::Bench& bench) {
  Vector3d sum = Vector3d::Zero();
  for (int i = 0; i < bench.model.rods[0].nodes(); ++i)
    sum += bench.model.rods[0].mass.at(0)[i] * bench.state.rods[0].position[i].cross(bench.state.rods[0].velocity[i]);
  return sum;
}

}  // namespace

std::vector<data::GateResult> rod_momentum(bool) {
  constexpr int elements = 100;
  std::vector<data::GateResult> out;
  {
    core::Bench bench = free_bench(elements);
    std::vector<Eigen::Vector4d> frames;
    for (int j = 0; j < elements; ++j)  // bent, tighter towards the tip, out of plane
      frames.push_back(core::turned_frame(core::along_x().q_W, Vector3d(0, 1e-4 * j * j, 0.01 * j)));
    lay_out(bench.model.rods[0], frames, frames.back(), bench.rod());
    bench.rod().velocity.fill(Vector3d(0.3, -0.2, 1));
    const Vector3d before = linear_momentum(bench);
    double worst = 0;
    for (int ms = 1; ms <= 1000; ++ms) {
      bench.step();
      worst = std::max(worst, (linear_momentum(bench) - before).norm() / before.norm());
    }
    out.push_back({"rod-momentum-linear", worst, 0, 1e-9, "1"});
  }
  {
    core::Bench bench = free_bench(elements);
    const Vector3d spin(0, 2 * units::pi, 0), middle(0.5, 0, 0);
    for (int i = 0; i <= elements; ++i) bench.rod().velocity.set(i, spin.cross(bench.rod().position[i] - middle));
    bench.rod().turn.fill(spin * bench.model.step_s);
    bench.rod().turn_before = bench.rod().turn;
    const Vector3d before = angular_momentum(bench);
    for (int ms = 1; ms <= 1000; ++ms) bench.step();
    out.push_back({"rod-momentum-angular", (angular_momentum(bench) - before).norm() / before.norm(), 0, 0.01, "1"});
  }
  return out;
}

}  // namespace ostium::app::gates
