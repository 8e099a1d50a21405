#pragma once
/// A small vessel for tests of sessions: a bent tube as a mesh, with scripts to push a wire through it.
#include <cmath>

#include "app/session/operator/setup.h"
#include "core/base/units.h"
#include "data/catalogue/catalogue.h"

namespace ostium::app {

/// 0.3 m of a tube of 5 mm, bent by 90 degrees in its middle; closed. Begins at the origin, along x.
inline vascular::Mesh bent_tube() {
  constexpr int rings = 80, sides = 20;
  constexpr double radius = 5e-3, bend = 0.06;
  const double quarter = bend * units::pi / 2;
  vascular::Mesh mesh;
  for (int r = 0; r <= rings; ++r) {
    const double s = 0.3 * r / rings - 0.01;
    const double a = std::min(std::max(0.0, s - 0.1), quarter) / bend, rest = std::max(0.0, s - 0.1 - quarter);
    const Eigen::Vector3d along(std::cos(a), std::sin(a), 0), across(-std::sin(a), std::cos(a), 0);
    const Eigen::Vector3d p(std::min(s, 0.1) + bend * std::sin(a) + rest * along.x(),
                            bend * (1 - std::cos(a)) + rest * along.y(), 0);
    for (int k = 0; k < sides; ++k) {
      const double b = 2 * units::pi * k / sides;
      mesh.vertices.push_back(p + radius * (std::cos(b) * across + std::sin(b) * Eigen::Vector3d::UnitZ()));
    }
  }
  for (int r = 0; r < rings; ++r)
    for (int k = 0; k < sides; ++k) {
      const int a = r * sides + k, b = r * sides + (k + 1) % sides;
      mesh.triangles.push_back({a, b + sides, b});
      mesh.triangles.push_back({a, a + sides, b + sides});
    }
  const auto lid = [&](int first, bool turned) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (int k = 0; k < sides; ++k) middle += mesh.vertices[static_cast<std::size_t>(first + k)] / sides;
    const int m = static_cast<int>(mesh.vertices.size());
    mesh.vertices.push_back(middle);
    for (int k = 0; k < sides; ++k) {
      const int a = first + k, b = first + (k + 1) % sides;
      mesh.triangles.push_back(turned ? std::array<int, 3>{a, b, m} : std::array<int, 3>{b, a, m});
    }
  };
  lid(0, true);
  lid(rings * sides, false);
  if (volume_m3(mesh) < 0)
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

inline const char* const there_and_back = R"({
  "schema": "ostium-script/1", "name": "there-and-back", "title": "A test",
  "tools": [ { "name": "wire", "instrument": "cook-j" } ],
  "landmarks": [ { "name": "bend", "at_mm": [142, 18, 0] } ],
  "steps": [
    { "do": "fluoroscopy", "on": true },
    { "do": "advance", "label": "to the bend", "tool": "wire", "speed_mm_s": 100, "turn_deg_s": 45,
      "until": [{ "tip_passes": "bend" }], "unless": [{ "push_exceeds_N": 5 }], "timeout_s": 5 },
    { "do": "turn", "tool": "wire", "turn_deg_s": 180, "until": [{ "turned_deg": 90 }] },
    { "do": "mark", "text": "there" },
    { "do": "withdraw", "tool": "wire", "speed_mm_s": 150, "until": [{ "inserted_mm": 50 }] }
  ]
})";

/// A run of a script in that tube.
inline RunSetup tube_setup(const std::string& script = there_and_back, std::uint64_t seed = 0) {
  RunSetup setup;
  setup.vessel = "tube";
  setup.mesh = bent_tube();
  setup.entry = {Eigen::Vector3d::Zero(), Eigen::Vector3d(0.05, 0, 0)};
  const std::size_t at = script.find("\"name\": \"") + 9;
  set_script(data::read_script(script.substr(at, script.find('"', at) - at) + ".json", script), setup);
  setup.seed = seed;
  return setup;
}

inline std::shared_ptr<const Vessel> tube_vessel() {
  static const std::shared_ptr<const Vessel> made = [] {
    std::string warnings;
    return make_vessel(tube_setup(), warnings);
  }();
  return made;
}

}  // namespace ostium::app
