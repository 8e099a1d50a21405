#pragma once
/// A part of the lumen's surface as a closed body.
#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "fluoro/matter/scene.h"

namespace ostium::app {

using Corners = std::array<int, 3>;

struct CutSurface {
  std::vector<int> vertices;           ///< of the whole surface; the cut one's are these, then the lids' middles
  std::vector<std::vector<int>> rims;  ///< where it is cut off; indices into `vertices`, each closed by a lid
  std::shared_ptr<const fluoro::Triangles> triangles;

  Eigen::Index count() const { return static_cast<Eigen::Index>(vertices.size() + rims.size()); }
};

/// The triangles that are kept, of a surface of so many vertices; each loop where they end gets a lid.
CutSurface cut_out(const std::vector<Corners>& triangles, std::size_t vertices,
                   const std::function<bool(const Corners&)>& kept);

/// Values of its vertices, one a column, from those of the whole surface; a lid's middle has its rim's mean.
template <class To, class From>
void take(const CutSurface& cut, const From& whole, To& out) {
  out.resize(whole.rows(), cut.count());
  Eigen::Index column = 0;
  for (int v : cut.vertices) out.col(column++) = whole.col(v);
  for (const std::vector<int>& rim : cut.rims) {
    out.col(column).setZero();
    for (int v : rim) out.col(column) += out.col(v);
    out.col(column++) /= static_cast<typename To::Scalar>(rim.size());
  }
}

}  // namespace ostium::app
