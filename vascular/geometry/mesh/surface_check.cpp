#include "vascular/geometry/mesh/surface_check.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numeric>

#include "vascular/geometry/mesh/bounding_volume_hierarchy.h"
#include "vascular/geometry/mesh/crossing.h"
#include "vascular/geometry/mesh/patient_frame.h"

namespace ostium::vascular {

namespace {

/// A triangle's edge, by its lower vertex.
struct Edge {
  int low, high, triangle;
  bool forwards;  ///< the triangle runs from low to high
};

std::vector<Edge> edges_of(const Mesh& mesh) {
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
    for (int k = 0; k < 3; ++k) {
      const int i = mesh.triangles[t][k], j = mesh.triangles[t][(k + 1) % 3];
      edges.push_back({std::min(i, j), std::max(i, j), t, i < j});
    }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  return edges;
}

/// Union-find sets.
class Groups {
 public:
  explicit Groups(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
  int of(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(int i, int j) { parent_[std::max(of(i), of(j))] = std::min(of(i), of(j)); }

 private:
  std::vector<int> parent_;
};

Eigen::Vector3d middle(const Mesh& mesh, const Edge& e) { return (mesh.vertices[e.low] + mesh.vertices[e.high]) / 2; }

/// Finds faulty edges; joins triangles that share one.
void check_edges(const Mesh& mesh, const std::vector<Edge>& edges, SurfaceReport& report, Groups& connected) {
  for (std::size_t i = 0, j = 0; i < edges.size(); i = j) {
    while (j < edges.size() && edges[j].low == edges[i].low && edges[j].high == edges[i].high) ++j;
    for (std::size_t k = i + 1; k < j; ++k) connected.join(edges[i].triangle, edges[k].triangle);
    if (j - i == 1) report.open_edges.add(middle(mesh, edges[i]));
    if (j - i > 2) report.branching_edges.add(middle(mesh, edges[i]));
    if (j - i == 2 && edges[i].forwards == edges[i + 1].forwards) report.flipped_edges.add(middle(mesh, edges[i]));
  }
}

/// Finds vertices whose triangles are not all connected by edges at that vertex.
void check_vertices(const Mesh& mesh, const std::vector<Edge>& edges, SurfaceReport& report) {
  // Corner 3 t + k; corners of one vertex are joined along the edges there.
  Groups fans(3 * mesh.triangles.size());
  const auto corner = [&](int t, int v) {
    const auto& tri = mesh.triangles[t];
    return 3 * t + static_cast<int>(std::find(tri.begin(), tri.end(), v) - tri.begin());
  };
  for (std::size_t i = 1; i < edges.size(); ++i)
    if (edges[i].low == edges[i - 1].low && edges[i].high == edges[i - 1].high)
      for (int v : {edges[i].low, edges[i].high})
        fans.join(corner(edges[i].triangle, v), corner(edges[i - 1].triangle, v));
  std::vector<int> fan(mesh.vertices.size(), -1);
  std::vector<bool> told(mesh.vertices.size());
  for (int c = 0; c < static_cast<int>(3 * mesh.triangles.size()); ++c) {
    const int v = mesh.triangles[c / 3][c % 3], f = fans.of(c);
    if (fan[v] < 0) fan[v] = f;
    if (fan[v] != f && !told[v]) {
      told[v] = true;
      report.pinched_vertices.add(mesh.vertices[v]);
    }
  }
}

/// Each open edge with the middle of the rim that it is part of: a triangle of that rim's lid.
std::vector<std::pair<Edge, Eigen::Vector3d>> lids_of(const Mesh& mesh, const std::vector<Edge>& edges) {
  std::vector<std::pair<Edge, Eigen::Vector3d>> lids;
  Groups rims(mesh.vertices.size());
  const auto same = [](const Edge& a, const Edge& b) { return a.low == b.low && a.high == b.high; };
  for (std::size_t i = 0; i < edges.size(); ++i)
    if ((i == 0 || !same(edges[i - 1], edges[i])) && (i + 1 == edges.size() || !same(edges[i], edges[i + 1])))
      lids.emplace_back(edges[i], Eigen::Vector3d::Zero()), rims.join(edges[i].low, edges[i].high);
  std::map<int, std::pair<Eigen::Vector3d, int>> sums;
  for (const auto& [edge, rim] : lids) {
    auto& [sum, count] = sums.try_emplace(rims.of(edge.low), Eigen::Vector3d::Zero(), 0).first->second;
    sum += middle(mesh, edge), ++count;
  }
  for (auto& [edge, rim] : lids) {
    const auto& [sum, count] = sums.at(rims.of(edge.low));
    rim = sum / count;
  }
  return lids;
}

/// Volumes are those under lids: without, they would be of cones to wherever one counts from.
void check_components(const Mesh& mesh, const std::vector<Edge>& edges, bool cavities, SurfaceReport& report,
                      Groups& connected) {
  const Eigen::Vector3d origin = box_middle(mesh);
  const auto six_volume = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    return (a - origin).dot((b - origin).cross(c - origin));
  };
  std::map<int, double> six_volumes;
  for (int t = 0; t < report.triangles; ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    six_volumes[connected.of(t)] += six_volume(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]);
  }
  for (const auto& [edge, rim] : lids_of(mesh, edges)) {
    const double lid = six_volume(mesh.vertices[edge.high], mesh.vertices[edge.low], rim);
    six_volumes[connected.of(edge.triangle)] += edge.forwards ? lid : -lid;
  }
  report.components = static_cast<int>(six_volumes.size());
  report.volume_m3 = 0;
  for (const auto& [first, volume] : six_volumes) report.volume_m3 += volume / 6;
  for (const auto& [first, volume] : six_volumes)
    if (volume < 0 && !cavities) report.inverted.add(mesh.vertices[mesh.triangles[first][0]]);
}

void describe_fault(std::string& text, const char* what, const SurfaceFault& fault) {
  if (!fault.count) return;
  const Eigen::Vector3d p_mm = mm_from_patient(fault.where.front());
  text += fmt::format("{} {}, the first at {:.2f} {:.2f} {:.2f} mm\n", fault.count, what, p_mm.x(), p_mm.y(), p_mm.z());
}

}  // namespace

void SurfaceFault::add(const Eigen::Vector3d& p) {
  ++count;
  if (where.size() < places_kept) where.push_back(p);
}

bool SurfaceReport::sound() const {
  return closed() && !pinched_vertices.count && !slivers.count && !inverted.count && !crossings.count && triangles > 0;
}

std::vector<std::array<int, 2>> crossing_triangles(const Mesh& mesh) {
  std::vector<std::array<int, 2>> pairs;
  BoundingVolumeHierarchy(mesh).for_each_pair([&](int i, int j) {
    if (triangles_cross(mesh, i, j)) pairs.push_back({i, j});
  });
  return pairs;
}

SurfaceReport check_surface(const Mesh& mesh, bool cavities) {
  SurfaceReport report;
  report.vertices = static_cast<int>(mesh.vertices.size());
  report.triangles = static_cast<int>(mesh.triangles.size());
  report.area_m2 = area_m2(mesh);
  for (const auto& [a, b, c] : mesh.triangles)
    if ((mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]).isZero(0))
      report.slivers.add(mesh.vertices[a]);
  const std::vector<Edge> edges = edges_of(mesh);
  Groups connected(mesh.triangles.size());
  check_edges(mesh, edges, report, connected);
  check_vertices(mesh, edges, report);
  check_components(mesh, edges, cavities, report, connected);
  for (const auto& [i, j] : crossing_triangles(mesh))
    report.crossings.add((mesh.vertices[mesh.triangles[i][0]] + mesh.vertices[mesh.triangles[j][0]]) / 2);
  return report;
}

std::string describe(const SurfaceReport& r) {
  std::string text;
  describe_fault(text, "open edges", r.open_edges);
  describe_fault(text, "edges of more than two triangles", r.branching_edges);
  describe_fault(text, "edges whose triangles face opposite ways", r.flipped_edges);
  describe_fault(text, "vertices in which two sheets touch", r.pinched_vertices);
  describe_fault(text, "triangles without area", r.slivers);
  describe_fault(text, "components that face inwards", r.inverted);
  describe_fault(text, "pairs of triangles that cross", r.crossings);
  return text.empty() ? "sound\n" : text;
}

}  // namespace ostium::vascular
