/// The picture of `core`'s README: a wire falling, and a twisted ring leaving its plane, as the step moves them.
#include <cmath>
#include <exception>
#include <iostream>

#include "core/base/units.h"
#include "core/samples/steel_wire.h"
#include "data/formats/svg.h"

namespace {

using namespace ostium;
using Eigen::Vector2d;
using Eigen::Vector3d;

template <class Project>
std::vector<Vector2d> projected(const core::RodState& rod, Project&& project) {
  std::vector<Vector2d> points;
  for (int i = 0; i < rod.position.size(); i += 2) points.push_back(project(rod.position[i]));
  return points;
}

void falling_wire(data::Drawing& drawing) {
  const auto project = [](const Vector3d& p) { return Vector2d(62 + 68 * p.x(), 18 - 68 * p.z()); };
  core::Bench bench = core::steel_bench({.elements = 512});
  drawing.text({6, 7}, "1 m of steel wire, let go: every 50 ms for 0.8 s");
  drawing.text({6, 12}, "red: converged reference at 0.3 and 0.8 s", 3);
  for (int ms = 0; ms <= 800; ++ms) {
    if (ms > 0) bench.step();
    if (ms % 50) continue;
    const int grey = 210 - ms * 200 / 800;
    const std::string colour =
        "rgb(" + std::to_string(grey) + "," + std::to_string(grey) + "," + std::to_string(grey + 20) + ")";
    drawing.line(projected(bench.rod(), project), colour, 0.5);
  }
  drawing.cross(project({0.79467, 0, -0.57652}), "#c00");
  drawing.cross(project({-0.3886, 0, -0.5578}), "#c00");
}

void writhing_ring(data::Drawing& drawing) {
  core::Bench bench = core::steel_bench({.elements = 128, .gravity = false});
  const core::Rod& rod = bench.model.rods[0];
  const Vector3d stiffness = stiffness_at_rest(rod, 1);
  const double critical = 2 * units::pi * std::sqrt(3.0) * stiffness[0] / stiffness[2];
  core::lay_out_ring(rod, 1.3 * critical, bench.rod());
  bench.inputs.rods[0].tip.hold = core::Hold::clamped;
  for (int i = 32; i < 64; ++i) bench.rod().velocity.set(i, Vector3d(0, 0.01, 0));
  drawing.text({142, 7}, "a ring, twisted 1.3 times beyond its stability");
  const int shown_ms[] = {0, 270, 300, 318};
  int ms = 0;
  for (int k = 0; k < 4; ++k) {
    for (; ms < shown_ms[k]; ++ms) bench.step();
    const Vector2d centre(162 + 42 * (k % 2), 34 + 42 * (k / 2));
    const auto project = [&](const Vector3d& p) {  // from the front, a little above
      const Vector3d q = p - Vector3d(0, 0, -0.16);
      return Vector2d(centre.x() + 95 * (q.x() + 0.35 * q.y()), centre.y() - 95 * (0.85 * q.z() + 0.45 * q.y()));
    };
    drawing.line(projected(bench.rod(), project), "#245", 0.9);
    drawing.text(centre + Vector2d(-5, 24), std::to_string(ms) + " ms", 3);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: " << argv[0] << " FILE.svg\n";
    return 2;
  }
  try {
    data::Drawing drawing(235, 105);
    falling_wire(drawing);
    writhing_ring(drawing);
    drawing.write(argv[1]);
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
  return 0;
}
