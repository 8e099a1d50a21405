/// The base of a straight weightless wire is turned by 180 degrees in 0.1 s. A torsional wave crosses 1 m of it in
/// 0.5 ms, so the distal end follows the ramp: 10 % after 10 ms, 90 % after 90 ms.
#include <Eigen/Geometry>
#include <cmath>

#include "app/gates/gate.h"
#include "core/base/units.h"
#include "core/samples/steel_wire.h"

namespace ostium::app::gates {

std::vector<data::GateResult> rod_torsion(bool quick) {
  std::vector<data::GateResult> out;
  for (int elements : quick ? std::vector{100} : std::vector{100, 512}) {
    core::Bench bench = core::steel_bench({.elements = elements, .gravity = false});
    const auto frame = [&] {
      const Eigen::Vector4d q = bench.rod().orientation[elements - 1];
      return Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
    };
    const Eigen::Quaterniond first = frame();
    double ms_10 = 0, ms_90 = 0, before = 0;
    for (int ms = 1; ms <= 200; ++ms) {
      const double rate = ms <= 100 ? units::pi / 0.1 : 0;
      bench.inputs.rods[0].base.turn_rate_W_rad_s = Eigen::Vector3d(rate, 0, 0);
      bench.step();
      const Eigen::Quaterniond turned = frame() * first.conjugate();
      const double part = 2 * std::atan2(turned.x(), turned.w()) / units::pi;
      const auto crossed = [&](double level) { return ms - 1 + (level - before) / (part - before); };
      if (ms_10 == 0 && part >= 0.1) ms_10 = crossed(0.1);
      if (ms_90 == 0 && part >= 0.9) ms_90 = crossed(0.9);
      before = part;
    }
    const std::string suffix = "-" + std::to_string(elements);
    out.push_back({"rod-torsion-10%" + suffix, ms_10, 10, 2, "ms"});
    out.push_back({"rod-torsion-90%" + suffix, ms_90, 90, 2, "ms"});
  }
  return out;
}

}  // namespace ostium::app::gates
