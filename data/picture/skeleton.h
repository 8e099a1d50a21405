#pragma once
/// Lines one pixel wide: thinning, branches, spurs. Neighbours are the eight around a pixel.
#include <Eigen/Core>
#include <vector>

#include "data/picture/image.h"

namespace ostium::data {

using Labels = Eigen::Array<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Connected parts, numbered from 1; 0 is what is not in the mask.
struct Parts {
  Labels label;
  int count = 0;
  std::vector<int> sizes() const;  ///< by label, from 0
};
Parts parts_of(const Mask& mask);

Mask dilated(const Mask& mask, int times = 1);
Mask closed(const Mask& mask);

/// Zhang and Suen 1984, Comm ACM 27:236.
Mask thinned(const Mask& mask);
/// How many of a pixel's neighbours are in the skeleton; 0 where the pixel itself is not.
Labels neighbours(const Mask& skeleton);

/// Branches: the skeleton less its junctions (pixels of more than two neighbours) and what touches them.
struct Branches {
  Parts parts;
  Mask junctions;
};
Branches branches_of(const Mask& skeleton);

/// Without spurs shorter than `pixels` and islands under four times that.
Mask pruned(Mask skeleton, int pixels);

/// Pixels of a branch (row, column) from one end to the other.
std::vector<Eigen::Vector2i> in_order(const std::vector<Eigen::Vector2i>& pixels);

}  // namespace ostium::data
