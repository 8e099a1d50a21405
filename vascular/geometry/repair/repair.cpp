#include "vascular/geometry/repair/repair.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "core/base/units.h"
#include "vascular/geometry/mesh/bounding_volume_hierarchy.h"
#include "vascular/geometry/mesh/surface_check.h"
#include "vascular/geometry/mesh/winding.h"
#include "vascular/geometry/remesh/level_set.h"
#include "vascular/geometry/remesh/smooth.h"
#include "vascular/geometry/repair/bridges.h"
#include "vascular/geometry/repair/calibre.h"
#include "vascular/geometry/repair/double_wall.h"
#include "vascular/geometry/repair/facing_ends.h"
#include "vascular/geometry/repair/finish.h"
#include "vascular/geometry/repair/limbs.h"
#include "vascular/geometry/repair/prolong.h"
#include "vascular/geometry/repair/sheets.h"
#include "vascular/geometry/repair/taper.h"

namespace ostium::vascular {

namespace {

using units::mm;
constexpr double least_voxel_m = 0.12e-3, most_voxel_m = 0.4e-3;
constexpr double finest_voxel_m = 0.06e-3;  // where a throat asks for it
constexpr double voxels_between = 2.2;      // of one lumen's limbs, so that they stay apart
constexpr double least_between_m = 0.05e-3;
constexpr double most_wall_voxels = 1.5e6;  // of the level set's surface
constexpr double most_cells = 4e6;          // the same of a voxel that was asked for: 4 GB, and some minutes
constexpr int smoothing_rounds = 16;
constexpr double least_missing_m = 0.8e-3;  // a larger gap between ends means a missing piece

class Mender {
 public:
  Mender(Mesh mesh, const RepairOptions& options) : mesh_(std::move(mesh)), options_(options) {}

  RepairedMesh run() {
    clean();
    sheets_ = sheets_of(mesh_);
    turn();
    smooth_noise();
    drop_outer_walls();
    close_openings();
    choose_voxel();
    keep_limbs_apart();
    say("filling the lumen");
    Mesh lumen = outer_surface(mesh_, result_.voxel_m);
    std::vector<Mesh> lumens = whole_lumens(lumen);
    while (was_cut(lumens) && result_.finest_m < result_.voxel_m) {
      say("filling the lumen on a finer grid, as it was cut in two");
      result_.voxel_m = std::max(result_.finest_m, result_.voxel_m / 2);
      lumen = outer_surface(mesh_, result_.voxel_m);
      lumens = whole_lumens(lumen);
    }
    note_cut_vessels(lumens);
    note_joined_pieces(static_cast<int>(lumens.size()));
    if (lumens.size() > 1 && prolong(lumens)) {
      say("filling the lumen to its new end");
      lumen = outer_surface(mesh_, result_.voxel_m);
      lumens = whole_lumens(lumen);
    }
    if (lumens.size() > 1 && sheets_.pieces > 1 && bridge(lumens)) {  // what is one piece has no gap
      say("filling the lumen once more");
      lumen = outer_surface(mesh_, result_.voxel_m);
      lumens = whole_lumens(lumen);
    }
    if (lumens.empty()) require_finer_voxel();
    if (lumens.empty() && left_out_ > 0) throw MeshError(too_small);
    if (lumens.empty())
      throw MeshError(
          "nothing closed comes out of the mesh; expected the wall of a vessel, with openings narrower than itself");
    if (left_out_ > 0) note("crumb left out (smaller than 8 mm3)", left_out_, {});
    // Only the part of the mesh that borders on the outside.
    const Mesh outside{mesh_.vertices, bordering_triangles(mesh_, WindingNumber(mesh_), result_.voxel_m / 20)};
    const BoundingVolumeHierarchy wall(outside);
    for (Mesh& part : lumens) {
      close_holes(part);
      say("coarsening the surface");
      append(result_.lumen, finished_surface(part, wall, result_.voxel_m, lumens.size(), options_.most_triangles));
    }
    if (lumens.size() > 1) uncross(result_.lumen);  // of vessels that nearly touch
    result_.lumens = static_cast<int>(lumens.size());
    return std::move(result_);
  }

 private:
  /// Where remains of another wall lie askew in a lumen, no wall may be near enough to where inside ends.
  void close_holes(Mesh& lumen) {
    std::vector<Eigen::Vector3d> where;
    for (const Opening& hole : close_all(lumen)) where.push_back(hole.middle);
    note("hole in the filled lumen closed", static_cast<int>(where.size()), where);
  }

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
    note("doubled triangle dropped", static_cast<int>(doubles.size()), doubles);
  }

  void smooth_noise() {
    if (!options_.smooth_noise) return;
    const Roughness rough = roughness(mesh_);
    const BoundingVolumeHierarchy tree(mesh_);
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

  /// Removes remains of the outer wall.
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

  void close_openings() {
    const std::vector<Opening> openings = openings_of(mesh_, sheets_);
    const std::vector<FacingEnds> pairs = facing_ends(openings, options_.longest_gap_m);
    std::vector<bool> closed(openings.size());
    std::vector<Eigen::Vector3d> joined, tapered, pinholes, holes;
    double widest_gap = 0, highest_step = 0;
    for (const FacingEnds& pair : pairs) {
      if (closed[pair.a] || closed[pair.b]) continue;
      closed[pair.a] = closed[pair.b] = true;
      if (const Taper done = taper(mesh_, sheets_, openings[pair.a], openings[pair.b]); done.step_m > 0) {
        tapered.push_back((openings[pair.a].middle + openings[pair.b].middle) / 2);
        highest_step = std::max(highest_step, done.step_m);
      }
      join(mesh_, openings[pair.a], openings[pair.b]);
      // Rims of a missing piece are jagged: a tube through them fills the dents.
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

  /// Extends a vessel that was cut off before a branch leaves it.
  bool prolong(const std::vector<Mesh>& lumens) {
    say("looking for branches beyond the end of their vessel");
    std::vector<VesselEnd> branches;
    for (std::size_t i = 1; i < lumens.size(); ++i)  // the largest lumen is the parent vessel
      for (const VesselEnd& end : ends_of(lumens[i])) branches.push_back(end);
    const BoundingVolumeHierarchy largest(lumens[0]);
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

  /// Throws MeshError where one that was asked for would fill the memory.
  double affordable_voxel() const {
    const double least_m = std::sqrt(area_m2(mesh_) / most_cells);
    if (options_.voxel_m < least_m)
      throw MeshError(
          fmt::format("--voxel {:g}: this mesh would have {:.2g} voxels along its wall; expected {:g} mm "
                      "or more",
                      options_.voxel_m / mm, area_m2(mesh_) / (options_.voxel_m * options_.voxel_m),
                      std::ceil(1e3 * least_m / mm) / 1e3));
    return options_.voxel_m;
  }

  /// More lumens than the mesh has pieces: a narrowing finer than the grid has gone.
  bool was_cut(const std::vector<Mesh>& lumens) const { return static_cast<int>(lumens.size()) > sheets_.pieces; }

  void note_cut_vessels(const std::vector<Mesh>& lumens) {
    if (!was_cut(lumens)) return;
    const BoundingVolumeHierarchy largest(lumens[0]);
    std::vector<Eigen::Vector3d> where;
    for (std::size_t i = 1; i < lumens.size(); ++i)
      where.push_back(*std::ranges::min_element(lumens[i].vertices, {}, [&](const Eigen::Vector3d& p) {
        return largest.nearest(p, std::numeric_limits<double>::infinity()).distance_m;
      }));
    note(fmt::format(
             "vessel cut in two, as it is narrower there than the grid of {:.2g} mm; a finer --voxel may keep it",
             result_.voxel_m / mm),
         static_cast<int>(lumens.size()) - sheets_.pieces, where);
  }

  /// Throws MeshError if voxels lose what is large enough.
  void require_finer_voxel() const {
    if (largest_piece_m3() > crumb_m3)
      throw MeshError(
          fmt::format("voxels of {:.2g} mm are too large for these vessels, of which nothing is left; expected a finer "
                      "--voxel",
                      result_.voxel_m / mm));
  }

  double largest_piece_m3() const {
    double largest = 0;
    for (const Mesh& piece : components_of(mesh_)) largest = std::max(largest, volume_m3(piece));
    return largest;
  }

  void choose_voxel() {
    if (options_.voxel_m > 0) {
      result_.voxel_m = result_.finest_m = affordable_voxel();
      return;
    }
    const BoundingVolumeHierarchy tree(mesh_);
    const int stride = 1 + static_cast<int>(mesh_.triangles.size() / 20'000);
    const std::vector<double> wide = calibres(mesh_, tree, stride);
    double narrow_m = percentile(wide, 0.02);
    if (options_.narrowest_m > 0) narrow_m = std::min(narrow_m, options_.narrowest_m);  // too small a share of a mesh
    // Where most of a mesh is as narrow, it would vanish.
    const double least_m = std::min(least_voxel_m, percentile(wide, 0.5) / voxels_across);
    const double affordable_m = std::sqrt(area_m2(mesh_) / most_wall_voxels);
    result_.finest_m = std::max(std::min(least_m, finest_voxel_m), affordable_m);
    const double from_m = options_.narrowest_m > 0 ? result_.finest_m : std::max(least_m, affordable_m);
    result_.voxel_m = std::clamp(narrow_m / voxels_across, from_m, std::max(most_voxel_m, from_m));
  }

  /// By finer voxels, if none were asked for and these fill no memory; else it is said.
  void keep_limbs_apart() {
    const std::optional<NearLimbs> near = nearest_limbs(mesh_, voxels_between * result_.voxel_m);
    if (!near) return;
    const double wanted_m = near->gap_m / voxels_between;
    if (options_.voxel_m <= 0)
      result_.voxel_m = std::min(result_.voxel_m,
                                 std::max({wanted_m, least_between_m, std::sqrt(area_m2(mesh_) / most_wall_voxels)}));
    if (result_.voxel_m <= near->gap_m) return;  // mostly, that does
    const bool affordable = wanted_m >= std::sqrt(area_m2(mesh_) / most_cells);
    note(fmt::format("place where limbs of one vessel, {:.2g} mm apart, may have become one{}", near->gap_m / mm,
                     affordable ? fmt::format(" (--voxel {:.2g} keeps them apart)", 0.95 * wanted_m / mm) : ""),
         1, {near->where});
  }

  std::vector<Mesh> whole_lumens(const Mesh& mesh) {
    std::vector<Mesh> lumens = components_of(mesh);
    const std::size_t before = lumens.size();
    // Voxels take a share of what is narrow: what is no crumb in the mesh stays.
    const double given_m3 = largest_piece_m3(),
                 least_m3 = given_m3 < crumb_m3 ? crumb_m3 : std::min(crumb_m3, given_m3 / 2);
    std::erase_if(lumens, [&](const Mesh& part) { return volume_m3(part) < least_m3; });
    left_out_ = static_cast<int>(before - lumens.size());
    return lumens;
  }

  /// Pieces that touch, cross, or come nearer to one another than is looked at, are one lumen.
  void note_joined_pieces(int lumens) {
    constexpr int most_pieces = 50;  // beyond, it is a soup of triangles
    if (sheets_.pieces < 2 || sheets_.pieces > most_pieces) return;
    const std::vector<Mesh> pieces = components_of(mesh_);
    const auto is_within = [](const Mesh& piece, const Mesh& other) {  // not with a part of it alone
      constexpr std::size_t looked_at = 16;
      for (std::size_t k = 0; k < looked_at; ++k)
        if (winding_number(other, piece.vertices[k * piece.vertices.size() / looked_at]) < 0.5) return false;
      return true;
    };
    const auto on_its_own = [&](const Mesh& piece) {
      return volume_m3(piece) > crumb_m3 && std::none_of(pieces.begin(), pieces.end(), [&](const Mesh& other) {
               return &other != &piece && is_within(piece, other);
             });
    };
    const auto count = static_cast<int>(std::count_if(pieces.begin(), pieces.end(), on_its_own));
    if (count > lumens)
      note(fmt::format("piece joined to another that it crosses, or comes nearer to than {:.2f} mm (a finer --voxel "
                       "keeps apart what "
                       "does not cross)",
                       result_.voxel_m / mm),
           count - lumens, {});
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

  Mesh mesh_;
  const RepairOptions& options_;
  Sheets sheets_;
  RepairedMesh result_;
  std::vector<CutEnd> cut_ends_;
  int left_out_ = 0;
};

}  // namespace

RepairedMesh repair_mesh(Mesh mesh, const RepairOptions& options) { return Mender(std::move(mesh), options).run(); }

}  // namespace ostium::vascular
