#include "vascular/geometry/centreline/centreline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <unordered_map>

#include "vascular/geometry/centreline/line_fit.h"
#include "vascular/geometry/centreline/voxel_links.h"
#include "vascular/geometry/centreline/voxels.h"
#include "vascular/geometry/mesh/patient_frame.h"
#include "vascular/geometry/mesh/winding.h"

namespace ostium::vascular {

namespace {

constexpr double unreached = std::numeric_limits<double>::infinity();
constexpr double reach = 2;            // a path covers what lies within this many radii
constexpr double cut_reach = 4;        // radii from its end in which a line looks for what was cut off from it
constexpr double shortest_loop = 8;    // radii by which the way round one is longer
constexpr double widest_from_lid = 3;  // radii: a widest place this near to a lid has no strand of its own to it

struct Paths {
  std::vector<double> length_m;  ///< along the cheapest path from the root
  std::vector<int> before;       ///< previous voxel on that path; -1 at the root
};

/// Dijkstra's cheapest paths from `root`.
Paths cheapest_paths(const Voxels& voxels, int root) {
  const std::size_t n = static_cast<std::size_t>(voxels.count());
  Paths paths{std::vector<double>(n, unreached), std::vector<int>(n, -1)};
  std::vector<double> cost(n, unreached);
  std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>> open;
  cost[root] = paths.length_m[root] = 0;
  open.push({0, root});
  while (!open.empty()) {
    const double c = open.top().first;
    const int v = open.top().second;
    open.pop();
    if (c > cost[v]) continue;
    voxels.neighbours(v, [&](int next, double step) {
      if (cost[next] <= c) return;  // no way from here is cheaper
      const double d = std::max((voxels.to_wall_m(v) + voxels.to_wall_m(next)) / 2, voxels.size_m() / 4);
      const double through = c + step / (d * d);
      if (through >= cost[next]) return;
      cost[next] = through;
      paths.length_m[next] = paths.length_m[v] + step;
      paths.before[next] = v;
      open.push({through, next});
    });
  }
  return paths;
}

/// A path's voxels from where it leaves earlier paths (or the root) to its end.
struct Strand {
  std::vector<int> voxels;
  int parent = -1;     ///< strand it leaves
  int leaves_at = -1;  ///< position in the parent's voxels
};

class Skeleton {
 public:
  Skeleton(const Voxels& voxels, int root)
      : voxels_(voxels),
        paths_(cheapest_paths(voxels, root)),
        owner_(voxels.count(), -1),
        reserve_m_(voxels.count(), -1),
        looked_from_(voxels.count(), -1) {}

  bool reaches(int voxel) const { return paths_.length_m[voxel] < unreached; }

  void add(int end) {
    Strand strand;
    int v = end;
    for (; v >= 0 && owner_[v] < 0; v = paths_.before[v]) strand.voxels.push_back(v);
    if (strand.voxels.empty()) return;
    std::reverse(strand.voxels.begin(), strand.voxels.end());
    if (v >= 0) {
      strand.parent = owner_[v];
      const auto& parent = strands_[strand.parent].voxels;
      strand.leaves_at = static_cast<int>(std::find(parent.begin(), parent.end(), v) - parent.begin());
    }
    for (int s : strand.voxels) owner_[s] = static_cast<int>(strands_.size());
    // Not from every voxel: neighbours cover much the same.
    int last = -1;
    for (int s : strand.voxels) {
      reserve_m_[s] = std::max(reserve_m_[s], 0.0F);
      if (last >= 0 && s != strand.voxels.back() &&
          (voxels_.place(s) - voxels_.place(last)).norm() < voxels_.to_wall_m(s) / 3)
        continue;
      come_near(last = s);
    }
    strands_.push_back(std::move(strand));
  }

  /// Adds every path that protrudes from the earlier ones by more than the local radius.
  void add_all() {
    std::vector<int> by_length;
    for (int v = 0; v < voxels_.count(); ++v)
      if (reaches(v)) by_length.push_back(v);
    std::sort(by_length.begin(), by_length.end(),
              [&](int a, int b) { return paths_.length_m[a] > paths_.length_m[b]; });
    for (int v : by_length)
      if (reserve_m_[v] < 0 && stands_out(v)) add(v);
  }

  const std::vector<Strand>& strands() const { return strands_; }

  /// Whether a strand ends within a loop: what lies beyond its end is reached by a long way round.
  bool ends_in_loop(const Strand& strand) const {
    const int end = strand.voxels.back();
    double radius = 0;
    for (std::size_t i = strand.voxels.size(); i-- > 0;) {
      radius = std::max(radius, voxels_.to_wall_m(strand.voxels[i]));
      if (away_m(strand.voxels[i], end) > cut_reach * radius) break;
    }
    std::unordered_map<int, int> joins;  // of a voxel: where its way from the root meets the strand's
    for (int v = end; v >= 0; v = paths_.before[v]) joins[v] = v;
    const auto joins_at = [&](int v) {
      std::vector<int> way;
      for (; !joins.contains(v); v = paths_.before[v]) way.push_back(v);
      for (int w : way) joins[w] = joins[v];
      return joins[v];
    };
    // Cheapest ways within reach of the end: where there is no loop, the way round by the root is hardly longer.
    std::unordered_map<int, double> direct_m = {{end, 0.0}};
    std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>> open;
    open.push({0, end});
    while (!open.empty()) {
      const auto [length_m, v] = open.top();
      open.pop();
      if (length_m > direct_m[v]) continue;
      const int at = joins_at(v);
      const double round_m = paths_.length_m[end] + paths_.length_m[v] - 2 * paths_.length_m[at];
      if (round_m - length_m > shortest_loop * std::max(radius, voxels_.to_wall_m(at))) return true;
      voxels_.neighbours(v, [&, length_m = length_m](int next, double step) {
        if (away_m(next, end) >= cut_reach * radius) return;
        const auto [known, is_new] = direct_m.try_emplace(next, length_m + step);
        if (!is_new && known->second <= length_m + step) return;
        known->second = length_m + step;
        open.push({length_m + step, next});
      });
    }
    return false;
  }

 private:
  double away_m(int a, int b) const { return (voxels_.place(a) - voxels_.place(b)).norm(); }

  bool stands_out(int end) const {
    if (strands_.empty()) return true;
    int v = end;
    while (v >= 0 && owner_[v] < 0) v = paths_.before[v];
    if (v < 0) return true;
    const double length = paths_.length_m[end] - paths_.length_m[v];
    return length > 2 * voxels_.to_wall_m(v) + 4 * voxels_.size_m();
  }

  /// Spreads from a voxel as far as its sphere reaches, and not where another's reaches farther beyond.
  void come_near(int from) {
    const double radius = reach * voxels_.to_wall_m(from) + 2 * voxels_.size_m();
    if (radius <= reserve_m_[from]) return;
    reserve_m_[from] = static_cast<float>(radius);
    looked_from_[from] = from;
    std::vector<int> open = {from};
    while (!open.empty()) {
      const int v = open.back();
      open.pop_back();
      voxels_.neighbours(v, [&](int next, double) {
        if (looked_from_[next] == from) return;  // by another neighbour
        looked_from_[next] = from;
        const float left = static_cast<float>(radius - (voxels_.place(next) - voxels_.place(from)).norm());
        if (left < 0 || left <= reserve_m_[next]) return;
        reserve_m_[next] = left;
        open.push_back(next);
      });
    }
  }

  const Voxels& voxels_;
  Paths paths_;
  std::vector<int> owner_;
  std::vector<float> reserve_m_;  ///< how much farther than to a voxel a path's sphere reaches; below 0: none does
  std::vector<int> looked_from_;  ///< the last voxel whose sphere was compared there
  std::vector<Strand> strands_;
};

/// Mean distance to the wall over the last third of a strand, without what is nearer to its end than to the wall: there
/// it is the lid that is near.
double width_of_end_m(const Voxels& voxels, const Strand& strand) {
  const Eigen::Vector3d& end = voxels.place(strand.voxels.back());
  std::size_t last = strand.voxels.size() - 1;
  while (last > 0 && (voxels.place(strand.voxels[last]) - end).norm() < voxels.to_wall_m(strand.voxels[last])) --last;
  const std::size_t first = std::min(last, 2 * strand.voxels.size() / 3);
  double sum = 0;
  for (std::size_t i = first; i <= last; ++i) sum += voxels.to_wall_m(strand.voxels[i]);
  return sum / static_cast<double>(last + 1 - first);
}

/// The widest end: the widest point itself if only one strand leaves it, otherwise the end of the strand from there
/// that is widest. Where all ends are those of loops, the widest point, too.
int widest_end(const Voxels& voxels, bool loops) {
  int widest = 0;
  for (int v = 1; v < voxels.count(); ++v)
    if (voxels.to_wall_m(v) > voxels.to_wall_m(widest)) widest = v;
  Skeleton skeleton(voxels, widest);
  skeleton.add_all();
  int leaving = 0;
  for (const Strand& strand : skeleton.strands())
    if ((voxels.place(strand.voxels.front()) - voxels.place(widest)).norm() < 2 * voxels.to_wall_m(widest)) ++leaving;
  if (leaving < 2) return widest;
  // A widest place just inside an end has a stub to it, which is no branch: it is wide halfway.
  const double radius = voxels.to_wall_m(widest);
  for (const Strand& strand : skeleton.strands())
    if ((voxels.place(strand.voxels.back()) - voxels.place(widest)).norm() < widest_from_lid * radius &&
        voxels.to_wall_m(strand.voxels[strand.voxels.size() / 2]) > 0.4 * radius)
      return strand.voxels.back();
  int end = widest;
  double best = 0;
  for (const Strand& strand : skeleton.strands()) {
    const double width = width_of_end_m(voxels, strand);
    if (width > best && !(loops && skeleton.ends_in_loop(strand))) best = width, end = strand.voxels.back();
  }
  return end;
}

/// Whether the mesh is one closed piece without a loop: by its corners less edges and triangles, which are 2 more for
/// each piece, and 2 less for each loop of one. Pieces that cross may make a loop together.
bool is_plain(const Mesh& mesh) {
  std::vector<bool> used(mesh.vertices.size());
  for (const auto& t : mesh.triangles)
    for (int v : t) used[static_cast<std::size_t>(v)] = true;
  return 2 * std::count(used.begin(), used.end(), true) - static_cast<long>(mesh.triangles.size()) == 4;
}

/// Where pieces cross, the wall of one goes on within another, and is no wall there.
Mesh outer_wall(const Mesh& mesh) {
  constexpr double beside_m = 5e-6;  // the wall on either side of which inside and outside are told
  return {mesh.vertices, bordering_triangles(mesh, WindingNumber(mesh), beside_m)};
}

/// With points between, where it is linked over a throat.
void add_place(const Eigen::Vector3d& p, double voxel_m, std::vector<Eigen::Vector3d>& line) {
  if (!line.empty()) {
    const Eigen::Vector3d from = line.back();
    const double away = (p - from).norm() / voxel_m;
    const int parts = away < 2 ? 1 : static_cast<int>(std::ceil(2 * away));
    for (int k = 1; k < parts; ++k) line.push_back(from + static_cast<double>(k) / parts * (p - from));
  }
  line.push_back(p);
}

/// Two lines end at one cut.
void add_cut(const TreeSphere& end, std::vector<Eigen::Vector3d>& cuts) {
  if (std::ranges::none_of(cuts,
                           [&](const Eigen::Vector3d& p) { return (p - end.p).norm() < 2 * cut_reach * end.radius_m; }))
    cuts.push_back(end.p);
}

/// Whether several strands leave a root in the middle of a lumen.
bool runs_through(const Skeleton& skeleton, const Voxels& voxels, int root) {
  return std::ranges::count_if(skeleton.strands(), [&](const Strand& strand) {
           return (voxels.place(strand.voxels.front()) - voxels.place(root)).norm() < voxels.to_wall_m(root);
         }) > 1;
}

}  // namespace

CentrelineResult find_centrelines(const Mesh& mesh, const CentrelineOptions& options) {
  const bool loops = !is_plain(mesh);  // there may be some
  const Mesh outer = loops ? outer_wall(mesh) : mesh;
  const BoundingVolumeHierarchy wall(outer);
  Voxels voxels(mesh, wall, options.most_voxels);
  if (voxels.count() == 0)
    throw MeshError("the mesh has no inside; expected a closed surface (ostium check says where not)");
  link_pieces(outer, wall, voxels);
  const int root = options.start ? voxels.nearest(*options.start) : widest_end(voxels, loops);
  Skeleton skeleton(voxels, root);
  for (const Eigen::Vector3d& end : options.ends) {
    const int voxel = voxels.nearest(end);
    if (!skeleton.reaches(voxel)) {
      const Eigen::Vector3d p = mm_from_patient(end);
      throw MeshError(
          fmt::format("the point {:.1f},{:.1f},{:.1f} mm lies in another piece of the mesh than the start; "
                      "expected points of one piece",
                      p.x(), p.y(), p.z()));
    }
    skeleton.add(voxel);
  }
  if (options.ends.empty()) skeleton.add_all();

  CentrelineResult result{.tree = {}, .voxel_m = voxels.size_m(), .cuts = {}};
  const bool through = loops && runs_through(skeleton, voxels, root);
  for (const Strand& strand : skeleton.strands()) {
    TreeBranch branch{.name = std::to_string(result.tree.branches.size() + 1), .parent = strand.parent, .spheres = {}};
    std::vector<Eigen::Vector3d> line;
    if (strand.parent >= 0) line.push_back(voxels.place(skeleton.strands()[strand.parent].voxels[strand.leaves_at]));
    for (int v : strand.voxels) add_place(voxels.place(v), voxels.size_m(), line);
    branch.spheres = fitted_spheres(line, wall, voxels.size_m());
    const bool cut = loops && options.ends.empty() && skeleton.ends_in_loop(strand);
    if (options.to_lids && !cut)
      carry_to_lid(branch.spheres, wall);
    else
      trim(branch.spheres, cut ? 0.95 : 0.75);
    if (cut) add_cut(branch.spheres.back(), result.cuts);
    if (strand.parent < 0 && options.to_lids && !through) {
      turn_round(branch.spheres);
      carry_to_lid(branch.spheres, wall, options.start ? 1 : widest_from_lid);
      turn_round(branch.spheres);
    }
    if (strand.parent >= 0) {
      const std::vector<TreeSphere>& on = result.tree.branches[strand.parent].spheres;
      const auto nearest = std::min_element(on.begin(), on.end(), [&](const TreeSphere& a, const TreeSphere& b) {
        return (a.p - line.front()).squaredNorm() < (b.p - line.front()).squaredNorm();
      });
      branch.parent_sphere = static_cast<int>(nearest - on.begin());
    }
    result.tree.branches.push_back(std::move(branch));
  }
  return result;
}

}  // namespace ostium::vascular
