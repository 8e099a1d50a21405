#include "app/session/model/penetration.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "core/base/units.h"
#include "core/contact/penetration_oracle.h"
#include "core/math/solid_angle.h"
#include "core/rod/introducer.h"

namespace ostium::app {

using Eigen::Vector3d;

namespace {

struct Ball {
  Vector3d p;
  double radius_m;
  double distance_m;
  bool is_tip, is_covered;
};

constexpr double cell_m = 5e-3;

struct Cell {
  int x, y, z;
  bool operator==(const Cell&) const = default;
};
struct CellHash {
  std::size_t operator()(const Cell& c) const {
    return static_cast<std::size_t>(c.x) * 73856093U ^ static_cast<std::size_t>(c.y) * 19349663U ^
           static_cast<std::size_t>(c.z) * 83492791U;
  }
};
Cell cell_of(const Vector3d& p) {
  const auto n = [](double x) { return static_cast<int>(std::floor(x / cell_m)); };
  return {n(p.x()), n(p.y()), n(p.z())};
}

/// Whether the point of `rod` at `from_tip` from its tip lies inside another instrument's lumen.
bool is_covered(const SessionModel& model, const SessionState& state, int rod, double from_tip_m) {
  const std::vector<core::RodState>& rods = state.rods.rods;
  const double inserted_m = rods[rod].inserted_m - from_tip_m;
  return std::any_of(model.rods.nestings.begin(), model.rods.nestings.end(), [&](const core::Nesting& n) {
    const double behind_m = rods[n.outer].inserted_m - inserted_m;
    return n.inner == rod && in_body(model.rods.rods[n.outer], rods[n.outer]) && behind_m > 0 && behind_m <= n.lumen_m;
  });
}

std::vector<Ball> balls_of(const SessionModel& model, const SessionState& state) {
  std::vector<Ball> balls;
  for (std::size_t r = 0; r < model.tools.size(); ++r) {
    const core::Rod& rod = model.rods.rods[r];
    if (!in_body(rod, state.rods.rods[r])) continue;
    for (int i = state.rods.rods[r].first + 1; i < rod.nodes(); ++i) {
      const double radius = rod.radius.at(0)[i];
      balls.push_back({state.rods.rods[r].position[i], radius, 1.5 * radius, i + 1 == rod.nodes(),
                       is_covered(model, state, static_cast<int>(r), rod.node_from_tip_m[i])});
    }
  }
  return balls;
}

/// The door is left out: the wall is closed without it.
double winding(const std::vector<Vector3d>& vertices, const core::SurfaceDescription& wall,
               const std::vector<char>& door, const Vector3d& p) {
  double sum = 0;
  for (std::size_t k = 0; k < wall.triangles.size(); ++k) {
    if (door[k]) continue;
    const auto& t = wall.triangles[k];
    sum += core::solid_angle(vertices[t[0]] - p, vertices[t[1]] - p, vertices[t[2]] - p);
  }
  return sum / (4 * units::pi);
}

}  // namespace

Penetration penetration(const SessionModel& model, const SessionState& state) {
  const core::SurfaceDescription& wall = model.vessel->wall;
  const vascular::LumenMoment at = moment(model, state);
  std::vector<Vector3d> vertices(wall.frames[0].size());
  for (std::size_t v = 0; v < vertices.size(); ++v)
    vertices[v] = wall_vertex(*model.vessel, state.wall_m, static_cast<int>(v), at);

  std::vector<Ball> balls = balls_of(model, state);
  double largest = 0;
  std::unordered_map<Cell, std::vector<std::size_t>, CellHash> cells;
  for (std::size_t b = 0; b < balls.size(); ++b) {
    cells[cell_of(balls[b].p)].push_back(b);
    largest = std::max(largest, 1.5 * balls[b].radius_m);
  }
  const Vector3d margin = Vector3d::Constant(largest);
  std::vector<char> door(wall.triangles.size(), 0);
  for (int t : wall.door) door[static_cast<std::size_t>(t)] = 1;
  for (std::size_t k = 0; k < wall.triangles.size(); ++k) {
    const auto& t = wall.triangles[k];
    const Vector3d &a = vertices[t[0]], &b = vertices[t[1]], &c = vertices[t[2]];
    const Cell low = cell_of(a.cwiseMin(b).cwiseMin(c) - margin), high = cell_of(a.cwiseMax(b).cwiseMax(c) + margin);
    for (int x = low.x; x <= high.x; ++x)
      for (int y = low.y; y <= high.y; ++y)
        for (int z = low.z; z <= high.z; ++z) {
          const auto found = cells.find({x, y, z});
          if (found == cells.end()) continue;
          for (const std::size_t n : found->second)
            if (!door[k] || balls[n].radius_m > wall.door_passes_m)
              balls[n].distance_m = std::min(balls[n].distance_m, core::triangle_distance(balls[n].p, a, b, c));
        }
  }
  Penetration out{.deepest_s = seconds(model, state)};
  for (const Ball& ball : balls) {
    const double depth = ball.radius_m - ball.distance_m;
    if (!ball.is_covered) out.deepest_m = std::max(out.deepest_m, depth);
    if ((ball.is_tip || depth > 0.5 * ball.radius_m) && winding(vertices, wall, door, ball.p) < 0.5) ++out.outside;
  }
  return out;
}

void add(const Penetration& other, Penetration& all) {
  if (other.deepest_m > all.deepest_m) all.deepest_m = other.deepest_m, all.deepest_s = other.deepest_s;
  all.outside += other.outside;
}

}  // namespace ostium::app
