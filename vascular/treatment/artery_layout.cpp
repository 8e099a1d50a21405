#include "vascular/treatment/artery_layout.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "vascular/patient/patient.h"

namespace ostium::vascular {

using Eigen::Vector3d;

namespace {

constexpr double unlimited_m = 1, least_share = 1e-6;
constexpr double ridge_m = 0.3e-3;   ///< nearer, two walls are one, and edges say how far they may part
constexpr double to_aorta_m = 1e-3;  ///< counts as a cell's distance from it
constexpr double far_m = 20e-3;      ///< farther, no artery comes in a beat
constexpr int still = -1;            ///< instead of a cell: the aorta

/// By how much more one vertex follows a cell than another.
struct CellShare {
  int cell = still;
  double weight = 0;
};

/// The few cells that a vertex follows, or that two vertices follow differently, in order.
class CellShares {
 public:
  void add(const LumenMap::Vertex& v, double sign) {
    add(v.first, sign * (1 - double{v.second_share})), add(v.second, sign * double{v.second_share});
  }
  /// Moves the weight from cells of more to cells of less, the foremost first: calls move(a, b, weight), a != b.
  template <class Move>
  void even_out(Move&& move) {
    std::sort(shares_, shares_ + count_, [](const CellShare& a, const CellShare& b) { return a.cell < b.cell; });
    for (int i = 0, j = 0; i < count_ && j < count_;) {
      CellShare &more = shares_[i], &less = shares_[j];
      if (more.weight < least_share)
        ++i;
      else if (less.weight > -least_share)
        ++j;
      else {
        const double by = std::min(more.weight, -less.weight);
        move(std::min(more.cell, less.cell), std::max(more.cell, less.cell), by);
        more.weight -= by, less.weight += by;
      }
    }
  }

 private:
  void add(const VertexSource& from, double weight) {
    if (from.part != VertexSource::coronary) return add(still, weight);
    add(from.below, weight * (1 - double{from.share})), add(from.above, weight * double{from.share});
  }
  void add(int cell, double weight) {
    CellShare* const end = shares_ + count_;
    CellShare* const own = std::find_if(shares_, end, [&](const CellShare& s) { return s.cell == cell; });
    if (own == end) shares_[count_++].cell = cell;
    own->weight += weight;
  }
  CellShare shares_[8];
  int count_ = 0;
};

/// Collects how much room each pair of cells has: the least that anybody says.
class Rooms {
 public:
  explicit Rooms(const FlowTree& tree) : tree_(tree), anchored_m_(tree.cells.size(), unlimited_m) {}

  bool are_in_a_row(int a, int b) const { return a != still && tree_.cells[a].branch == tree_.cells[b].branch; }
  double along_m(int a, int b) const { return tree_.cells[b].s_m - tree_.cells[a].s_m; }

  /// That of an edge which is `stretch` as long as its cells lie apart.
  void take_stretched(int a, int b, double apart_m, double stretch) {
    if (!are_in_a_row(a, b)) return take(a, b, stretch * apart_m);
    for (int c = a + 1; c <= b; ++c) take(c - 1, c, stretch * along_m(c - 1, c));
  }
  void take(int a, int b, double room_m) {
    double& room = a == still ? anchored_m_[b] : rooms_.try_emplace({b, a}, unlimited_m).first->second;
    room = std::min(room, room_m);
  }
  void write(ArteryLayout& to) const {
    for (const auto& [cells, room_m] : rooms_) to.ties.push_back({cells.second, cells.first, room_m});
    to.anchored_m = anchored_m_;
  }

 private:
  const FlowTree& tree_;
  std::map<std::pair<int, int>, double> rooms_;
  std::vector<double> anchored_m_;
};

using Centres = std::vector<std::vector<Vector3d>>;  ///< [frame][cell]

/// What the edges of the wall say.
void look_at_edges(const LumenMap& map, const Centres& centres, const core::SurfaceDescription& wall, Rooms& rooms) {
  const auto edge = [&](int v, int w) {
    CellShares shares;
    shares.add(map.sources[v], 1), shares.add(map.sources[w], -1);
    struct Move {
      int a, b;
      double apart_m;
    } moves[8];
    int count = 0;
    double way_m = 0;
    shares.even_out([&](int a, int b, double weight) {
      const double apart_m = rooms.are_in_a_row(a, b) ? rooms.along_m(a, b)
                             : a == still             ? to_aorta_m
                                                      : (centres[0][a] - centres[0][b]).norm();
      moves[count++] = {a, b, apart_m};
      way_m += weight * apart_m;
    });
    if (count == 0) return;
    double length_m = unlimited_m;
    for (const std::vector<Vector3d>& p : wall.frames) length_m = std::min(length_m, (p[v] - p[w]).norm());
    for (int k = 0; k < count; ++k) rooms.take_stretched(moves[k].a, moves[k].b, moves[k].apart_m, length_m / way_m);
  };
  const int vertices = static_cast<int>(map.sources.size());
  for (const auto& t : wall.triangles)
    for (int k = 0; k < 3; ++k)
      if (const int v = t[k], w = t[(k + 1) % 3]; v < w && w < vertices) edge(v, w);  // each edge is in two triangles
}

/// What the walls of two arteries that have parted say: each cell, and the nearest one of each artery before its own.
void look_at_gaps(const FlowTree& tree, const Centres& centres, Rooms& rooms) {
  for (int b = 0; b < static_cast<int>(tree.cells.size()); ++b)
    for (int branch = 0; branch < tree.cells[b].branch; ++branch) {
      double least_m = unlimited_m;
      int nearest = still;
      for (int a = tree.branches[branch].first; a < tree.branches[branch].last; ++a) {
        const double walls_m = tree.cells[a].healthy_m + tree.cells[b].healthy_m;
        if ((centres[0][a] - centres[0][b]).norm() - walls_m > far_m) continue;
        for (const std::vector<Vector3d>& p : centres)
          if (const double gap_m = (p[a] - p[b]).norm() - walls_m; gap_m < least_m) least_m = gap_m, nearest = a;
      }
      if (nearest != still && least_m > ridge_m) rooms.take(nearest, b, least_m);
    }
}

/// The cell of its parent that a branch begins beside.
int beside(const FlowTree& tree, const FlowBranch& branch, const std::vector<Vector3d>& centre) {
  const auto away = [&](int c) { return (centre[c] - centre[branch.first]).squaredNorm(); };
  const FlowBranch& parent = tree.branches[branch.parent];
  int nearest = parent.first;
  for (int c = parent.first; c < parent.last; ++c)
    if (away(c) < away(nearest)) nearest = c;
  return nearest;
}

/// As the tree has it.
ArteryLayout in_rows(const FlowTree& tree) {
  ArteryLayout layout;
  for (const FlowCell& cell : tree.cells) {
    layout.upstream.push_back(cell.upstream);
    layout.from_m.push_back(cell.upstream < 0 ? 0 : (cell.length_m + tree.cells[cell.upstream].length_m) / 2);
  }
  return layout;
}

ArteryLayout with_ties(ArteryLayout layout, Rooms rooms) {
  for (std::size_t c = 0; c < layout.upstream.size(); ++c)
    rooms.take(layout.upstream[c], static_cast<int>(c), layout.from_m[c]);
  rooms.write(layout);
  return layout;
}

}  // namespace

ArteryLayout layout_of(const FlowTree& tree) { return with_ties(in_rows(tree), Rooms(tree)); }

ArteryLayout layout_of(const FlowTree& tree, const LumenMap& map, const core::SurfaceDescription& wall) {
  Centres centres(wall.frames.size());
  for (std::size_t f = 0; f < centres.size(); ++f)
    for (std::size_t c = 0; c < tree.cells.size(); ++c)
      centres[f].push_back(map.coronary.position(c, static_cast<double>(f) / static_cast<double>(centres.size())));
  ArteryLayout layout = in_rows(tree);
  for (const FlowBranch& branch : tree.branches) {
    if (branch.parent < 0) continue;
    const int up = beside(tree, branch, centres[0]);
    double& from_m = layout.from_m[branch.first];
    layout.upstream[branch.first] = up;
    from_m = std::max(from_m, (centres[0][up] - centres[0][branch.first]).norm());
  }
  Rooms rooms(tree);
  look_at_edges(map, centres, wall, rooms);
  look_at_gaps(tree, centres, rooms);
  return with_ties(std::move(layout), std::move(rooms));
}

}  // namespace ostium::vascular
