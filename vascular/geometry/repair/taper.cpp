#include "vascular/geometry/repair/taper.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <queue>

#include "core/base/units.h"

namespace ostium::vascular {

namespace {

constexpr double least_step_m = 0.3e-3;
constexpr double least_share = 0.08;    // smallest step, relative to the narrower radius
constexpr double gentle = 4;            // a gap of this many steps is a gentle slope already
constexpr double steps_long = 8;        // at its steepest, a taper rises by 1.5 over this many steps: 11 degrees
constexpr double diameters_long = 1.5;  // and is at most this many diameters long
constexpr int sectors = 72;

/// Distance of a rim from a line, by direction around the line.
class RimRadius {
 public:
  RimRadius(const Mesh& mesh, const Opening& rim, const Eigen::Vector3d& middle, const Eigen::Vector3d& axis)
      : middle_(middle), u_(axis.unitOrthogonal()), v_(axis.cross(u_)), sum_(sectors, 0), weight_(sectors, 0) {
    constexpr int per_edge = 16;
    for (int h : rim.half_edges) {
      const auto& t = mesh.triangles[h / 3];
      const Eigen::Vector3d &p = mesh.vertices[t[h % 3]], &q = mesh.vertices[t[(h + 1) % 3]];
      for (int i = 0; i < per_edge; ++i) {
        const Eigen::Vector3d x = p + (q - p) * (i + 0.5) / per_edge;
        const std::size_t k = static_cast<std::size_t>(sector(x)) % sectors;
        const double w = (q - p).norm();
        sum_[k] += w * across(x);
        weight_[k] += w;
      }
    }
  }

  double across(const Eigen::Vector3d& p) const { return std::hypot((p - middle_).dot(u_), (p - middle_).dot(v_)); }

  double towards(const Eigen::Vector3d& p) const {
    const int at = static_cast<int>(sector(p));
    double sum = 0, weight = 0;
    for (int wide = 1; weight <= 0 && wide < sectors; ++wide) {
      sum = weight = 0;
      for (int k = at - wide; k <= at + wide; ++k) {
        const std::size_t i = static_cast<std::size_t>(k + 2 * sectors) % sectors;
        sum += sum_[i];
        weight += weight_[i];
      }
    }
    return weight > 0 ? sum / weight : 0;
  }

 private:
  double sector(const Eigen::Vector3d& p) const {
    const double angle = std::atan2((p - middle_).dot(v_), (p - middle_).dot(u_));
    return std::clamp((angle / (2 * units::pi) + 0.5) * sectors, 0.0, sectors - 1e-9);
  }

  Eigen::Vector3d middle_, u_, v_;
  std::vector<double> sum_, weight_;
};

struct Nearest {
  double distance_m = 0;
  int rim = -1;  ///< nearest vertex of the rim
};

/// Distances along the edges of the opening's piece, up to `limit_m`.
std::map<int, Nearest> along_wall(const Mesh& mesh, const Sheets& sheets, const Opening& from, double limit_m) {
  std::map<int, std::vector<int>> around;
  for (std::size_t t = 0; t < sheets.piece.size(); ++t) {
    if (sheets.piece[t] != from.piece) continue;
    const auto& c = mesh.triangles[t];
    if ((mesh.vertices[c[0]] - from.middle).norm() > limit_m + 2 * from.diameter_m) continue;
    for (int k = 0; k < 3; ++k) {
      around[c[k]].push_back(c[(k + 1) % 3]);
      around[c[(k + 1) % 3]].push_back(c[k]);
    }
  }
  std::map<int, Nearest> reached;
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  for (int h : from.half_edges) {
    const int v = mesh.triangles[h / 3][h % 3];
    reached[v] = {0, v};
    open.push({0, v});
  }
  while (!open.empty()) {
    const auto [d, v] = open.top();
    open.pop();
    if (d > reached[v].distance_m) continue;
    for (int w : around[v]) {
      const double next = d + (mesh.vertices[w] - mesh.vertices[v]).norm();
      const auto [entry, fresh] = reached.try_emplace(w, Nearest{next, reached[v].rim});
      if (next > limit_m) {
        if (fresh) reached.erase(entry);
        continue;
      }
      if (!fresh && entry->second.distance_m <= next) continue;
      entry->second = {next, reached[v].rim};
      open.push({next, w});
    }
  }
  return reached;
}

}  // namespace

Taper taper(Mesh& mesh, const Sheets& sheets, const Opening& a, const Opening& b) {
  const Opening &wide = a.diameter_m >= b.diameter_m ? a : b, &narrow = a.diameter_m >= b.diameter_m ? b : a;
  const Eigen::Vector3d axis = (wide.outwards - narrow.outwards).normalized();
  const double gap = std::max(0.0, (narrow.middle - wide.middle).dot(axis));
  const RimRadius here(mesh, wide, narrow.middle, axis), there(mesh, narrow, narrow.middle, axis);
  std::map<int, double> step;  // per vertex of the wide rim
  double highest = 0, mean = 0;
  for (int h : wide.half_edges) {
    const int v = mesh.triangles[h / 3][h % 3];
    const Eigen::Vector3d& p = mesh.vertices[v];
    step[v] = here.across(p) - there.towards(p);
    highest = std::max(highest, step[v]);
    mean += step[v] / static_cast<double>(wide.half_edges.size());
  }
  const double least = std::max(least_step_m, least_share * narrow.diameter_m / 2);
  if (mean < least || gap > gentle * mean) return {};

  const double length = std::min(steps_long * mean, diameters_long * wide.diameter_m);
  const std::map<int, Nearest> near = along_wall(mesh, sheets, wide, length);
  std::map<int, Eigen::Vector3d> normal;
  for (const auto& [v, n] : near) normal[v] = Eigen::Vector3d::Zero();
  for (std::size_t t = 0; t < sheets.piece.size(); ++t) {
    if (sheets.piece[t] != wide.piece) continue;
    const auto& [p, q, r] = mesh.triangles[t];
    const Eigen::Vector3d area = (mesh.vertices[q] - mesh.vertices[p]).cross(mesh.vertices[r] - mesh.vertices[p]);
    for (int v : {p, q, r})
      if (const auto found = normal.find(v); found != normal.end()) found->second += area;
  }
  for (const auto& [v, n] : near) {
    const double x = 1 - n.distance_m / length;
    mesh.vertices[v] -= x * x * (3 - 2 * x) * step[n.rim] * normal[v].normalized();
  }
  return {highest, length};
}

}  // namespace ostium::vascular
