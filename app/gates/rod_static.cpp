/// A horizontal cantilever at rest under its own weight, solved statically from the straight shape. Reference: the
/// exact elastica, EI theta'' = w (L - s) cos(theta).
#include "app/gates/gate.h"
#include "core/samples/steel_wire.h"

namespace ostium::app::gates {

std::vector<data::GateResult> rod_static(bool) {
  struct Case {
    const char* name;
    core::WireOptions wire;
    double x_m, drop_m, tolerance_mm;
  };
  const Case cases[] = {
      {"rod-static-60GPa-100", {.elements = 100}, 0.431883, 0.836061, 0.2},
      {"rod-static-60GPa-512", {.elements = 512}, 0.431883, 0.836061, 0.02},
      {"rod-static-1GPa-100", {.elements = 100, .E_Pa = 1e9}, 0.040842, 0.983230, 1},
      {"rod-static-200GPa-100", {.elements = 100, .E_Pa = 200e9}, 0.791278, 0.569080, 0.2},
      {"rod-static-0.4m-100", {.elements = 100, .length_m = 0.4}, 0.393777, 0.065719, 0.05},
  };
  std::vector<data::GateResult> out;
  for (const Case& c : cases) {
    core::Bench bench = steel_bench(c.wire);
    bench.settle();  // if no equilibrium is found, the shape stays straight and the gate fails
    out.push_back({c.name, 1e3 * (bench.tip() - Eigen::Vector3d(c.x_m, 0, -c.drop_m)).norm(), 0, c.tolerance_mm, "mm"});
  }
  return out;
}

}  // namespace ostium::app::gates
