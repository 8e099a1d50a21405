#include "vascular/geometry/centreline/voxel_links.h"

#include <map>
#include <numeric>

namespace ostium::vascular {

namespace {

constexpr long longest_throat = 24;             // voxels
constexpr std::size_t least_piece = 3;          // voxels: smaller ones are crumbs at a rough wall
constexpr std::size_t most_looked_from = 2000;  // voxels of a piece
constexpr std::size_t most_tried = 400;         // pairs

using Piece = std::vector<int>;

/// Of neighbours, the largest first.
std::vector<Piece> pieces_of(const Voxels& voxels) {
  std::vector<Piece> pieces;
  std::vector<bool> seen(static_cast<std::size_t>(voxels.count()), false);
  for (int first = 0; first < voxels.count(); ++first) {
    if (seen[static_cast<std::size_t>(first)]) continue;
    Piece piece = {first};
    seen[static_cast<std::size_t>(first)] = true;
    for (std::size_t i = 0; i < piece.size(); ++i)
      voxels.neighbours(piece[i], [&](int next, double) {
        if (seen[static_cast<std::size_t>(next)]) return;
        seen[static_cast<std::size_t>(next)] = true;
        piece.push_back(next);
      });
    pieces.push_back(std::move(piece));
  }
  std::ranges::stable_sort(pieces, std::ranges::greater{}, &Piece::size);
  return pieces;
}

struct Pair {
  double away_m;
  int from, to;
};

/// From a piece to what is reached, the nearest first.
std::vector<Pair> pairs_of(const Voxels& voxels, const Piece& piece, const std::vector<bool>& reached) {
  std::vector<Pair> pairs;
  const std::size_t stride = 1 + piece.size() / most_looked_from;
  for (std::size_t i = 0; i < piece.size(); i += stride)
    voxels.around(piece[i], longest_throat, [&](int other) {
      if (reached[static_cast<std::size_t>(other)])
        pairs.push_back({(voxels.place(other) - voxels.place(piece[i])).norm(), piece[i], other});
    });
  const auto nearest = pairs.begin() + static_cast<std::ptrdiff_t>(std::min(pairs.size(), most_tried));
  std::ranges::partial_sort(pairs, nearest, {}, &Pair::away_m);
  pairs.erase(nearest, pairs.end());
  return pairs;
}

bool see_each_other(const Voxels& voxels, const Pair& pair, const BoundingVolumeHierarchy& wall) {
  const Eigen::Vector3d way = voxels.place(pair.to) - voxels.place(pair.from);
  return wall.hits(voxels.place(pair.from), way / pair.away_m, pair.away_m).empty();
}

/// Of each triangle: which of the pieces that hang together by corners it belongs to, by one of their corners.
std::vector<int> surfaces_of(const Mesh& mesh) {
  std::vector<int> leads_to(mesh.vertices.size());
  std::iota(leads_to.begin(), leads_to.end(), 0);
  const auto end = [&](int v) {
    while (leads_to[static_cast<std::size_t>(v)] != v)
      v = leads_to[static_cast<std::size_t>(v)] =
          leads_to[static_cast<std::size_t>(leads_to[static_cast<std::size_t>(v)])];
    return v;
  };
  for (const auto& [a, b, c] : mesh.triangles)
    leads_to[static_cast<std::size_t>(end(b))] = end(a), leads_to[static_cast<std::size_t>(end(c))] = end(a);
  std::vector<int> out;
  for (const auto& t : mesh.triangles) out.push_back(end(t[0]));
  return out;
}

/// Links what can be of pieces that lie in one surface, the largest first.
void link_in_surface(std::vector<Piece> pieces, const BoundingVolumeHierarchy& wall, Voxels& voxels) {
  std::vector<bool> reached(static_cast<std::size_t>(voxels.count()), false);
  const auto reach = [&](const Piece& piece) {
    for (const int voxel : piece) reached[static_cast<std::size_t>(voxel)] = true;
  };
  reach(pieces.front());
  pieces.erase(pieces.begin());
  for (bool found = true; found && !pieces.empty();) {
    found = false;
    std::erase_if(pieces, [&](const Piece& piece) {
      for (const Pair& pair : pairs_of(voxels, piece, reached))
        if (see_each_other(voxels, pair, wall)) {
          voxels.link(pair.from, pair.to);
          reach(piece);
          return found = true;
        }
      return false;
    });
  }
}

}  // namespace

void link_pieces(const Mesh& outer, const BoundingVolumeHierarchy& wall, Voxels& voxels) {
  std::vector<Piece> pieces = pieces_of(voxels);
  std::erase_if(pieces, [](const Piece& piece) { return piece.size() < least_piece; });
  if (pieces.size() < 2) return;
  const std::vector<int> surface = surfaces_of(outer);
  std::map<int, std::vector<Piece>> in_surface;
  for (Piece& piece : pieces) {
    const int triangle = wall.nearest(voxels.place(piece.front()), 1).triangle;
    in_surface[surface[static_cast<std::size_t>(triangle)]].push_back(std::move(piece));
  }
  for (auto& [of, own] : in_surface)
    if (own.size() > 1) link_in_surface(std::move(own), wall, voxels);
}

}  // namespace ostium::vascular
