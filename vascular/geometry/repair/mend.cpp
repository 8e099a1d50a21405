#include "vascular/geometry/repair/mend.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "vascular/box_tree.h"
#include "vascular/geometry/repair/bridges.h"
#include "vascular/geometry/repair/calibre.h"
#include "vascular/geometry/repair/decimate.h"
#include "vascular/geometry/repair/double_wall.h"
#include "vascular/geometry/repair/level_set.h"
#include "vascular/geometry/repair/prolong.h"
#include "vascular/geometry/repair/sheets.h"
#include "vascular/geometry/repair/smooth.h"
#include "vascular/geometry/repair/taper.h"
#include "vascular/surface_check.h"

namespace ostium {

namespace {

constexpr double mm = 1e-3;
constexpr double least_voxel_m = 0.12e-3, most_voxel_m = 0.4e-3;
constexpr double voxels_across = 3.5;       // of the narrowest vessels
constexpr double most_wall_voxels = 1.5e6;  // of the level set's surface
constexpr double crumb_m3 = 8e-9;           // lumens smaller than this are left out
constexpr int smoothing_rounds = 16;
constexpr double least_missing_m = 0.8e-3;  // a gap between ends is a missing piece from here on
constexpr int calibre_stride = 4, most_uncrossings = 12;
constexpr double longest_edge_m = 2.2e-3;
constexpr double chance_voxels = 0.05;         // where the level set puts a vertex within these is chance
constexpr double most_turn = 0 - 1 - 1;        // cosine, of a triangle whose corners go onto the wall
constexpr double least_height = 0.02 - 1 - 1;  // of a triangle over its longest edge, the same
constexpr int most_returns = 6;
constexpr double cell_at_1_mm_m = 0.6e-3;  // as the contour of our own anatomy has it

class Mender {
 public:
  Mender(Mesh mesh, const MendOptions& options) : mesh_(std::move(mesh)), options_(options) {}

  Mended run() {
    clean();
    sheets_ = sheets_of(mesh_);
    turn();
    smooth_noise();
    drop_outer_walls();
    close_openings();
    result_.voxel_m = options_.voxel_m > 0 ? options_.voxel_m : chosen_voxel();
    say("filling the lumen");
    Mesh lumen = outer_surface(mesh_, result_.voxel_m);
    std::vector<Mesh> lumens = whole_lumens(lumen);
    if (lumens.size() > 1 && prolong(lumens)) {
      say("filling the lumen to its new end");
      lumen = outer_surface(mesh_, result_.voxel_m);
      lumens = whole_lumens(lumen);
    }
    if (lumens.size() > 1 && bridge(lumens)) {
      say("filling the lumen once more");
      lumen = outer_surface(mesh_, result_.voxel_m);
      lumens = whole_lumens(lumen);
    }
    if (lumens.empty())
      throw MeshError(
          "nothing closed comes out of the mesh; expected the wall of a vessel, with openings narrower than itself");
    if (left_out_ > 0) note("crumb left out (smaller than 8 mm3)", left_out_, {});
    wall_.vertices = mesh_.vertices;
    wall_.triangles = bordering_triangles(mesh_, result_.voxel_m / 20);
    const BoxTree wall(wall_);
    wall_tree_ = &wall;
    for (const Mesh& part : lumens) append(result_.lumen, finished(part, lumens.size()));
    result_.lumens = static_cast<int>(lumens.size());
    return std::move(result_);
  }

 private:
  void say(const std::string& what) const {
    if (options_.progress) options_.progress(what);
  }

  void note(const std::string& what, int count, std::vector<Eigen::Vector3d> where) {
    if (!count) return;
    if (where.size() > SurfaceFault::places_kept) where.resize(SurfaceFault::places_kept);
    result_.notes.push_back({what, count, std::move(where)});
  }

  void clean() {
    std::set<std::array<int, 3>> seen;
    std::vector<Eigen::Vector3d> doubles, slivers;
    std::erase_if(mesh_.triangles, [&](const std::array<int, 3>& t) {
      const Eigen::Vector3d area =
          (mesh_.vertices[t[1]] - mesh_.vertices[t[0]]).cross(mesh_.vertices[t[2]] - mesh_.vertices[t[0]]);
      std::array<int, 3> key = t;
      std::sort(key.begin(), key.end());
      const bool sliver = area.isZero(0), twice = !sliver && !seen.insert(key).second;
      if (sliver) slivers.push_back(mesh_.vertices[t[0]]);
      if (twice) doubles.push_back(mesh_.vertices[t[0]]);
      return sliver || twice;
    });
    note("triangle without area dropped", static_cast<int>(slivers.size()), slivers);
    note("triangle that was there twice dropped", static_cast<int>(doubles.size()), doubles);
  }

  void smooth_noise() {
    if (!options_.smooth_noise) return;
    const Roughness rough = roughness(mesh_);
    const BoxTree tree(mesh_);
    const int stride = 1 + static_cast<int>(mesh_.triangles.size() / 5'000);
    if (!rough.noisy(percentile(calibres(mesh_, tree, stride), 0.5) / 2)) return;
    smooth(mesh_, smoothing_rounds);
    note(fmt::format("rough surface smoothed (vertices stood out by {:.2f} mm)", rough.height_m / mm), 1, {});
  }

  void turn() {
    const Orientation turned = orient(mesh_, sheets_);
    note("triangle that faced another way than its piece turned", static_cast<int>(turned.flipped.size()),
         turned.flipped);
    note("piece that faced inwards turned", static_cast<int>(turned.inverted.size()), turned.inverted);
  }

  void drop_outer_walls() {
    say("looking for double walls");
    const DoubleWall wall = find_double_wall(mesh_, sheets_);
    if (!wall.triangles) return;
    note(fmt::format("triangle of an outer wall dropped ({:.2f} mm outside the lumen)", wall.thickness_m / mm),
         wall.triangles, {wall.where});
    std::size_t t = 0;
    std::erase_if(mesh_.triangles, [&](const std::array<int, 3>&) { return wall.outer[t++]; });
    sheets_ = sheets_of(mesh_);
    drop_shreds(10 * wall.thickness_m * wall.thickness_m);
    orient(mesh_, sheets_);
  }

  /// What is left of the outer wall.
  void drop_shreds(double least_m2) {
    std::vector<double> area(static_cast<std::size_t>(sheets_.pieces), 0);
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const auto& [a, b, c] = mesh_.triangles[t];
      area[sheets_.piece[t]] +=
          (mesh_.vertices[b] - mesh_.vertices[a]).cross(mesh_.vertices[c] - mesh_.vertices[a]).norm() / 2;
    }
    std::size_t t = 0;
    std::erase_if(mesh_.triangles, [&](const std::array<int, 3>&) { return area[sheets_.piece[t++]] < least_m2; });
    sheets_ = sheets_of(mesh_);
  }

  /// Two openings are one cut vessel if they are alike and face each other.
  double gap_between(const Opening& a, const Opening& b) const {
    const Eigen::Vector3d gap = b.middle - a.middle;
    const double wide = (a.diameter_m + b.diameter_m) / 2, ratio = a.diameter_m / b.diameter_m;
    if (!a.end || !b.end || ratio > 1.5 || ratio < 1 / 1.5) return -1;
    if (gap.norm() > std::min(options_.longest_gap_m, 3 * wide) || a.outwards.dot(b.outwards) > -0.6) return -1;
    const double across = (gap - gap.dot(a.outwards) * a.outwards).norm();
    if (across > 0.35 * wide + 0.3 * gap.norm() || gap.dot(a.outwards) < -0.3 * wide) return -1;
    return gap.norm();
  }

  void close_openings() {
    const std::vector<Opening> openings = openings_of(mesh_, sheets_);
    struct Pair {
      double gap_m;
      std::size_t a, b;
    };
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < openings.size(); ++i)
      for (std::size_t j = i + 1; j < openings.size(); ++j)
        if (const double gap = gap_between(openings[i], openings[j]); gap >= 0) pairs.push_back({gap, i, j});
    std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.gap_m < b.gap_m; });
    std::vector<bool> closed(openings.size());
    std::vector<Eigen::Vector3d> joined, tapered, pinholes, holes;
    double widest_gap = 0, highest_step = 0;
    for (const Pair& pair : pairs) {
      if (closed[pair.a] || closed[pair.b]) continue;
      closed[pair.a] = closed[pair.b] = true;
      if (const Taper done = taper(mesh_, sheets_, openings[pair.a], openings[pair.b]); done.step_m > 0) {
        tapered.push_back((openings[pair.a].middle + openings[pair.b].middle) / 2);
        highest_step = std::max(highest_step, done.step_m);
      }
      join(mesh_, openings[pair.a], openings[pair.b]);
      // Where a piece is missing, rims are jagged: a tube through them fills the dents.
      if (pair.gap_m > least_missing_m) {
        const double radius = std::min(openings[pair.a].diameter_m, openings[pair.b].diameter_m) / 2;
        append(mesh_, body_of({.p_from = openings[pair.a].middle, .p_to = openings[pair.b].middle, .radius_m = radius},
                              std::min(1 * mm, 0.5 * radius)));
      }
      joined.push_back((openings[pair.a].middle + openings[pair.b].middle) / 2);
      widest_gap = std::max(widest_gap, pair.gap_m);
    }
    for (std::size_t i = 0; i < openings.size(); ++i) {
      if (closed[i]) continue;
      if (openings[i].end) keep_end(openings[i]);
      cap(mesh_, openings[i]);
      (openings[i].end ? result_.ends : openings[i].pinhole() ? pinholes : holes).push_back(openings[i].middle);
    }
    note(fmt::format("end joined to the end that faces it (gaps up to {:.1f} mm)", widest_gap / mm),
         static_cast<int>(joined.size()), joined);
    note(fmt::format("shelf between two ends of one vessel made a taper (up to {:.1f} mm high)", highest_step / mm),
         static_cast<int>(tapered.size()), tapered);
    note("pinhole closed", static_cast<int>(pinholes.size()), pinholes);
    note("hole in a wall closed", static_cast<int>(holes.size()), holes);
    note("open end of a vessel closed", static_cast<int>(result_.ends.size()), result_.ends);
  }

  void keep_end(const Opening& opening) {
    CutEnd cut{{}, opening.middle, opening.outwards, opening.diameter_m / 2};
    for (int h : opening.half_edges) cut.rim.push_back(mesh_.vertices[mesh_.triangles[h / 3][h % 3]]);
    cut_ends_.push_back(std::move(cut));
  }

  /// What was cut off before a branch leaves it.
  bool prolong(const std::vector<Mesh>& lumens) {
    say("looking for branches beyond the end of their vessel");
    std::vector<VesselEnd> branches;
    for (std::size_t i = 1; i < lumens.size(); ++i)  // the largest is whose branches they are
      for (const VesselEnd& end : ends_of(lumens[i])) branches.push_back(end);
    const BoxTree largest(lumens[0]);
    std::vector<Eigen::Vector3d> where;
    double longest = 0;
    for (const CutEnd& cut : cut_ends_) {
      if (largest.nearest(cut.middle, 3 * result_.voxel_m).triangle < 0) continue;
      const auto length = missing_length_m(cut, branches, options_.longest_gap_m);
      if (!length) continue;
      append(mesh_, carried_on(cut, 2 * result_.voxel_m, *length));
      where.push_back(cut.middle);
      longest = std::max(longest, *length);
    }
    note(fmt::format("end carried on past a branch that begins beyond it (up to {:.1f} mm)", longest / mm),
         static_cast<int>(where.size()), where);
    return !where.empty();
  }

  double chosen_voxel() const {
    const BoxTree tree(mesh_);
    const int stride = 1 + static_cast<int>(mesh_.triangles.size() / 20'000);
    const double narrow = percentile(calibres(mesh_, tree, stride), 0.02);
    const double affordable = std::sqrt(area_m2(mesh_) / most_wall_voxels);
    return std::clamp(narrow / voxels_across, std::max(least_voxel_m, affordable), std::max(most_voxel_m, affordable));
  }

  std::vector<Mesh> whole_lumens(const Mesh& mesh) {
    std::vector<Mesh> lumens = components_of(mesh);
    const std::size_t before = lumens.size();
    std::erase_if(lumens, [](const Mesh& part) { return volume_m3(part) < crumb_m3; });
    left_out_ = static_cast<int>(before - lumens.size());
    return lumens;
  }

  bool bridge(const std::vector<Mesh>& lumens) {
    say(fmt::format("bridging gaps between {} lumens", lumens.size()));
    const std::vector<Bridge> bridges = find_bridges(lumens, options_.longest_gap_m);
    for (bool to_end : {true, false}) {
      std::vector<Eigen::Vector3d> where;
      double widest = 0;
      for (const Bridge& b : bridges) {
        if (b.to_end != to_end) continue;
        append(mesh_, body_of(b, 0.8 * b.radius_m));
        where.push_back((b.p_from + b.p_to) / 2);
        widest = std::max(widest, b.gap_m);
      }
      note(fmt::format("gap bridged, end to {} (up to {:.1f} mm)", to_end ? "end" : "wall", widest / mm),
           static_cast<int>(where.size()), where);
    }
    return !bridges.empty();
  }

  /// With edges as long as the calibre asks, vertices on the wall that was given.
  Mesh finished(const Mesh& fine, std::size_t parts) const {
    say("coarsening the surface");
    std::vector<double> edge = wanted_edges(fine);
    Mesh mesh = decimate(fine, edge, chance_voxels * result_.voxel_m);
    if (mesh.triangles.size() * parts > options_.most_triangles) {
      const double longer =
          std::sqrt(static_cast<double>(mesh.triangles.size() * parts) / static_cast<double>(options_.most_triangles));
      for (double& e : edge) e *= longer;
      mesh = decimate(fine, edge, chance_voxels * result_.voxel_m);
    }
    onto_wall(mesh);
    uncross(mesh);
    return mesh;
  }

  /// The level set and its coarsening are off by a part of a voxel; the wall is where the mesh said.
  void onto_wall(Mesh& mesh) const {
    std::vector<Eigen::Vector3d> normal(mesh.vertices.size(), Eigen::Vector3d::Zero());
    for (const auto& [a, b, c] : mesh.triangles)
      for (int v : {a, b, c})
        normal[v] += (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
    std::vector<Eigen::Vector3d> step(mesh.vertices.size(), Eigen::Vector3d::Zero());
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      const BoxTree::Nearest near = wall_tree_->nearest(mesh.vertices[v], result_.voxel_m);
      // Along the normal only: sideways, vertices would come together where the wall has an edge.
      const Eigen::Vector3d out = normal[v].normalized();
      if (near.triangle >= 0) step[v] = (near.point - mesh.vertices[v]).dot(out) * out;
    }
    // Where a triangle would turn over or go flat, its corners go half as far, and not at all in the end.
    const std::vector<Eigen::Vector3d> from = mesh.vertices;
    for (int round = 0; round <= most_returns; ++round) {
      for (std::size_t v = 0; v < from.size(); ++v) mesh.vertices[v] = from[v] + step[v];
      std::vector<bool> returns(from.size());
      bool any = false;
      for (const auto& t : mesh.triangles) {
        if (!spoils(t, from, mesh.vertices)) continue;
        any = true;
        for (int v : t) returns[v] = true;
      }
      if (!any) return;
      for (std::size_t v = 0; v < from.size(); ++v)
        if (returns[v]) step[v] *= round + 1 < most_returns ? 0.5 : 0;
    }
  }

  static bool spoils(const std::array<int, 3>& t, const std::vector<Eigen::Vector3d>& before,
                     const std::vector<Eigen::Vector3d>& after) {
    const auto area = [&](const std::vector<Eigen::Vector3d>& p) {
      return Eigen::Vector3d((p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]));
    };
    const auto longest2 = [&](const std::vector<Eigen::Vector3d>& p) {
      return std::max(
          {(p[t[1]] - p[t[0]]).squaredNorm(), (p[t[2]] - p[t[1]]).squaredNorm(), (p[t[0]] - p[t[2]]).squaredNorm()});
    };
    const Eigen::Vector3d was = area(before), is = area(after);
    const double height = is.norm() / longest2(after), had = was.norm() / longest2(before);
    return was.dot(is) < most_turn * was.norm() * is.norm() || height < std::min(least_height, 0.5 * had);
  }

  /// Where triangles cross, the surface is evened out until they do not.
  void uncross(Mesh& mesh) const {
    for (int round = 0; round < most_uncrossings; ++round) {
      const auto pairs = crossing_triangles(mesh);
      if (pairs.empty()) return;
      std::vector<bool> moves(mesh.vertices.size());
      for (const auto& pair : pairs)
        for (int t : pair)
          for (int v : mesh.triangles[t]) moves[v] = true;
      for (int wider = 0; wider <= round / 3; ++wider) {
        const std::vector<bool> before = moves;
        for (const auto& t : mesh.triangles)
          if (before[t[0]] || before[t[1]] || before[t[2]]) moves[t[0]] = moves[t[1]] = moves[t[2]] = true;
      }
      std::vector<Eigen::Vector3d> sum(mesh.vertices.size(), Eigen::Vector3d::Zero());
      std::vector<int> count(mesh.vertices.size(), 0);
      for (const auto& t : mesh.triangles)
        for (int k = 0; k < 3; ++k) sum[t[k]] += mesh.vertices[t[(k + 1) % 3]], ++count[t[k]];
      for (std::size_t v = 0; v < moves.size(); ++v)
        if (moves[v]) mesh.vertices[v] = (mesh.vertices[v] + sum[v] / count[v]) / 2;
    }
  }

  std::vector<double> wanted_edges(const Mesh& fine) const {
    const BoxTree tree(fine);
    const std::vector<double> diameter = calibres(fine, tree, calibre_stride);
    std::vector<double> edge(fine.vertices.size(), 0);
    std::vector<int> count(fine.vertices.size(), 0);
    for (std::size_t i = 0; i < diameter.size(); ++i) {
      if (diameter[i] <= 0) continue;
      for (int v : fine.triangles[i * calibre_stride]) edge[v] += diameter[i], ++count[v];
    }
    for (std::size_t v = 0; v < edge.size(); ++v)
      if (count[v]) edge[v] /= count[v];
    // Vertices that none of the triangles looked at has take their neighbours'.
    for (int round = 0; round < 2; ++round)
      for (const auto& t : fine.triangles)
        for (int k = 0; k < 3; ++k)
          if (const int from = t[k], to = t[(k + 1) % 3]; edge[from] > 0 && edge[to] == 0) edge[to] = edge[from];
    for (double& e : edge) {
      const double radius = e > 0 ? e / 2 : mm;
      e = std::clamp(cell_at_1_mm_m * std::pow(radius / mm, 0.75), 1.2 * result_.voxel_m,
                     std::max(longest_edge_m, 1.2 * result_.voxel_m));
    }
    return edge;
  }

  Mesh mesh_;
  const MendOptions& options_;
  Sheets sheets_;
  Mesh wall_;  ///< of mesh_, what borders on the outside
  const BoxTree* wall_tree_ = nullptr;
  Mended result_;
  std::vector<CutEnd> cut_ends_;
  int left_out_ = 0;
};

}  // namespace

Mended mend(Mesh mesh, const MendOptions& options) { return Mender(std::move(mesh), options).run(); }

std::vector<Mesh> components_of(const Mesh& mesh) {
  const Sheets sheets = sheets_of(mesh);
  std::vector<Mesh> parts(static_cast<std::size_t>(sheets.pieces));
  std::vector<int> index(mesh.vertices.size(), -1), owner(mesh.vertices.size(), -1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Mesh& part = parts[sheets.piece[t]];
    std::array<int, 3> renamed;
    for (int k = 0; k < 3; ++k) {
      const int v = mesh.triangles[t][k];
      if (owner[v] != sheets.piece[t]) {
        owner[v] = sheets.piece[t];
        index[v] = static_cast<int>(part.vertices.size());
        part.vertices.push_back(mesh.vertices[v]);
      }
      renamed[k] = index[v];
    }
    part.triangles.push_back(renamed);
  }
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t p = 0; p < parts.size(); ++p) order.push_back({-volume_m3(parts[p]), p});
  std::sort(order.begin(), order.end());
  std::vector<Mesh> sorted;
  for (const auto& [volume, p] : order) sorted.push_back(std::move(parts[p]));
  return sorted;
}

}  // namespace ostium
