#include "vascular/geometry/centreline/voxel_links.h"

#include <array>
#include <numeric>

namespace ostium::vascular {

namespace {

constexpr long longest_throat = 24;             // voxels
constexpr std::size_t least_piece = 3;          // voxels: smaller ones are crumbs at a rough wall
constexpr std::size_t most_looked_from = 5000;  // voxels of a piece
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

}  // namespace

void link_pieces(Voxels& voxels, const BoundingVolumeHierarchy& wall) {
  std::vector<Piece> pieces = pieces_of(voxels);
  std::erase_if(pieces, [](const Piece& piece) { return piece.size() < least_piece; });
  if (pieces.size() < 2) return;
  std::vector<bool> reached(static_cast<std::size_t>(voxels.count()), false);
  const auto reach = [&](const Piece& piece) {
    for (const int voxel : piece) reached[static_cast<std::size_t>(voxel)] = true;
  };
  reach(pieces.front());
  pieces.erase(pieces.begin());
  for (bool found = true; found;) {
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

}  // namespace ostium::vascular
