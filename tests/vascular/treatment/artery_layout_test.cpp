/// Arteries that give way keep a wall that is neither folded nor through itself: also where they part, and beyond.
#include "vascular/treatment/artery_layout.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "vascular/geometry/mesh/surface_check.h"
#include "vascular/physiology/physiology.h"
#include "vascular/treatment/artery_bed.h"
#include "vascular/treatment/wall_shape.h"

namespace ostium::vascular {
namespace {

using Eigen::Vector3d;

/// The person in whose circumflex a balloon folded the wall: the second marginal branch went with a cell of its parent
/// that lies 2.6 mm before it, and 0.6 mm aside, while the one beside it stayed.
struct PulledArteries {
  Patient patient = make_patient(person(2, {}), {});
  PhysiologyModel physiology = make_physiology(patient);
  const FlowTree& tree = physiology.flow.tree;
  LumenMap map = make_lumen_map(patient, physiology.flow);
  WallShape shape{patient, map, tree};
  std::vector<double> radius_m = healthy();
  ArteryBedModel bed = make_artery_bed(tree, layout_of(tree, map, shape.wall(radius_m)));
  ArteryBedScratch scratch;
  std::vector<Vector3d> load_N = std::vector<Vector3d>(tree.cells.size(), Vector3d::Zero());

  std::vector<double> healthy() const {
    std::vector<double> radii;
    for (const FlowCell& cell : tree.cells) radii.push_back(cell.healthy_m);
    return radii;
  }
  Vector3d centre(int cell) const { return map.centre(static_cast<std::size_t>(cell), {}); }
  Vector3d towards(int from, int to) const { return (centre(to) - centre(from)).normalized(); }
  const FlowBranch& parent(const FlowBranch& branch) const {
    return tree.branches[static_cast<std::size_t>(branch.parent)];
  }
  double gap_m(int a, int b) const {
    return (centre(a) - centre(b)).norm() - tree.cells[static_cast<std::size_t>(a)].healthy_m -
           tree.cells[static_cast<std::size_t>(b)].healthy_m;
  }
  void pull(const FlowBranch& branch, int first, int last, const Vector3d& by_N) {
    for (int c = std::max(first, branch.first); c < std::min(last, branch.last); ++c)
      load_N[static_cast<std::size_t>(c)] = by_N;
  }
  /// Gives way for a second, at the end of which the arteries are let go: how far they lie aside.
  std::vector<Vector3d> pulled() {
    ArteryBedState state;
    state.aside_P.assign(tree.cells.size(), Vector3d::Zero());
    for (int n = 0; n < 125; ++n) step(bed, {load_N, {}}, 8e-3, state, scratch);
    for (Vector3d& load : load_N) load.setZero();
    return state.aside_P;
  }
  /// Pairs of triangles of the coronary arteries that cross then, in systole.
  std::size_t crossings(const std::vector<Vector3d>& aside_P) const {
    Mesh mesh;
    shape.at(radius_m, {.phase = 0.35, .aside_P = aside_P}, mesh.vertices);
    for (const auto& t : patient.lumen.triangles)
      if (map.sources[static_cast<std::size_t>(t[0])].first.part == VertexSource::coronary) mesh.triangles.push_back(t);
    return crossing_triangles(mesh).size();
  }
};

double farthest_m(const std::vector<Vector3d>& aside_P) {
  double most = 0;
  for (const Vector3d& z : aside_P) most = std::max(most, z.norm());
  return most;
}

PulledArteries& pulled_arteries() {
  static PulledArteries the_only_ones;
  return the_only_ones;
}

TEST(ArteryLayout, AForkIsNotPulledThroughItself) {
  PulledArteries& a = pulled_arteries();
  int forks = 0;
  for (const FlowBranch& side : a.tree.branches) {
    if (side.parent < 0) continue;
    const FlowBranch& parent = a.parent(side);
    const int at = a.bed.layout.upstream[static_cast<std::size_t>(side.first)];
    // The side branch to one side, its parent a little way on to the other.
    for (const Vector3d& way : {a.towards(at, side.first + 5), a.towards(at, at - 3)}) {
      a.pull(side, side.first + 2, side.first + 8, 2 * way), a.pull(parent, at + 6, at + 12, -2 * way);
      const std::vector<Vector3d> aside_P = a.pulled();
      EXPECT_EQ(a.crossings(aside_P), 0) << side.name;
      EXPECT_GT(farthest_m(aside_P), 1e-3) << side.name;
      ++forks;
    }
  }
  EXPECT_GT(forks, 20);
}

TEST(ArteryLayout, ArteriesThatLieSideBySideDoNotGoThroughEachOther) {
  PulledArteries& a = pulled_arteries();
  int pairs = 0;
  for (const FlowBranch& one : a.tree.branches)
    for (const FlowBranch& other : a.tree.branches) {
      if (&other >= &one) break;
      int from = one.first, to = other.first;
      for (int c = one.first + (one.parent < 0 ? 0 : 6); c < one.last; ++c)
        for (int d = other.first; d < other.last; ++d)
          if (a.gap_m(c, d) < a.gap_m(from, to) || from == one.first) from = c, to = d;
      if (a.gap_m(from, to) > 4e-3) continue;
      const Vector3d way = a.towards(from, to);
      a.pull(one, one.first, one.last, 0.5 * way), a.pull(other, other.first, other.last, -0.5 * way);
      const std::vector<Vector3d> aside_P = a.pulled();
      EXPECT_EQ(a.crossings(aside_P), 0) << one.name << ", " << other.name;
      EXPECT_GT(farthest_m(aside_P), 1e-3);
      ++pairs;
    }
  EXPECT_GT(pairs, 6);
}

}  // namespace
}  // namespace ostium::vascular
