/// A horizontal clamped wire released from rest, without losses. Reference: adaptive and second-order integrators, 200
/// elements, converged: the tip is at x 0.79467, drop 0.57652 m after 0.3 s and at x -0.3886, drop 0.5578 m after 0.8
/// s.
#include <algorithm>
#include <cmath>

#include "app/gates/gate.h"
#include "core/samples/steel_wire.h"

namespace ostium::app::gates {

namespace {

data::GateResult tip_after_300_ms(const core::Bench& bench) {
  return {"rod-swing-tip-0.3s-" + std::to_string(bench.model.rods[0].elements),
          1e3 * (bench.tip() - Eigen::Vector3d(0.79467, 0, -0.57652)).norm(), 0, 0.8, "mm"};
}

double length(const core::RodState& rod) {
  double sum = 0;
  for (int j = 0; j < rod.force.size(); ++j) sum += (rod.position[j + 1] - rod.position[j]).norm();
  return sum;
}

}  // namespace

data::GateResult swing_tip(int elements) {
  core::Bench bench = core::steel_bench({.elements = elements});
  for (int ms = 1; ms <= 300; ++ms) bench.step();
  return tip_after_300_ms(bench);
}

std::vector<data::GateResult> rod_swing(bool quick) {
  std::vector<data::GateResult> out;
  for (int elements : quick ? std::vector{100} : std::vector{100, 512}) {
    core::Bench bench = core::steel_bench({.elements = elements});
    const std::string suffix = "-" + std::to_string(elements);
    double stretch = 0;
    for (int ms = 1; ms <= 3000; ++ms) {
      bench.step();
      stretch = std::max(stretch, std::fabs(length(bench.rod()) - 1));
      if (ms == 300) out.push_back(tip_after_300_ms(bench));
      if (ms == 800)
        out.push_back({"rod-swing-tip-0.8s" + suffix, 1e3 * (bench.tip() - Eigen::Vector3d(-0.3886, 0, -0.5578)).norm(),
                       0, 3, "mm"});
    }
    out.push_back({"rod-swing-stretch" + suffix, 100 * stretch, 0, 1e-5, "%"});
  }
  return out;
}

}  // namespace ostium::app::gates
