#include "fluoro/base/resample.h"

#include <algorithm>
#include <boost/math/special_functions/bessel.hpp>
#include <cmath>
#include <vector>

#include "fluoro/base/lanes.h"

namespace ostium::fluoro {

using Eigen::Index;

Plane block_means(const Plane& plane, int cells) {
  const Index side = plane.rows() / cells;
  Plane sums = Plane::Zero(cells, plane.cols());
  for (Index row = 0; row < cells * side; ++row) sums.row(row / side) += plane.row(row);
  Plane out(cells, cells);
  for (int c = 0; c < cells; ++c)
    out.col(c) = sums.middleCols(c * side, side).rowwise().sum() / static_cast<float>(side * side);
  return out;
}

namespace {

struct Between {
  Index low;
  float high_share;
};

std::vector<Between> between(Index coarse, Index size) {
  std::vector<Between> out(static_cast<std::size_t>(size));
  for (Index i = 0; i < size; ++i) {
    const double at = std::clamp((i + 0.5) * coarse / size - 0.5, 0.0, coarse - 1.0);
    const Index low = std::min(static_cast<Index>(at), std::max<Index>(coarse - 2, 0));
    out[static_cast<std::size_t>(i)] = {low, static_cast<float>(at - low)};
  }
  return out;
}

/// Weights of the pixels 0, 1, 2 ... away: exp(-t) I_n(t) with t = sigma^2, whose variance is exactly sigma^2 for any
/// width (Lindeberg 1990, IEEE PAMI 12:234). For wide kernels, where the Bessel functions overflow, the Gaussian limit.
std::vector<float> gaussian(double sigma) {
  const double t = sigma * sigma;
  std::vector<double> weights;
  double sum = 0;
  for (int n = 0; n == 0 || weights.back() > 1e-4 * weights[0]; ++n) {
    // Boost's, as libm's writes a global (signgam) from every thread. Beyond t = 700 the Bessel function overflows;
    // there the sampled Gaussian differs by only 1 / (8 t).
    weights.push_back(t < 500 ? std::exp(-t) * boost::math::cyl_bessel_i(n, t) : std::exp(-0.5 * n * n / t));
    sum += (n ? 2 : 1) * weights.back();
  }
  std::vector<float> out;
  for (double w : weights) out.push_back(static_cast<float>(w / sum));
  return out;
}

}  // namespace

void enlarge(const Plane& coarse, Index size, Plane& out) {
  const std::vector<Between> rows = between(coarse.rows(), size), columns = between(coarse.cols(), size);
  Plane wide(coarse.rows(), size);
  for (Index c = 0; c < size; ++c) {
    const auto [low, share] = columns[static_cast<std::size_t>(c)];
    wide.col(c) = coarse.col(low) + share * (coarse.col(std::min(low + 1, coarse.cols() - 1)) - coarse.col(low));
  }
  out.resize(size, size);
  for (Index r = 0; r < size; ++r) {
    const auto [low, share] = rows[static_cast<std::size_t>(r)];
    out.row(r) = wide.row(low) + share * (wide.row(std::min(low + 1, coarse.rows() - 1)) - wide.row(low));
  }
}

void gaussian_blur(Plane& plane, double sigma_pixels, Beyond beyond, Plane& scratch) {
  if (!(sigma_pixels > 0)) return;
  const std::vector<float> weights = gaussian(sigma_pixels);
  const Index reach = static_cast<Index>(weights.size()) - 1, rows = plane.rows(), columns = plane.cols();
  scratch.resize(rows, columns);
  const auto blur_line = [&](auto&& at, float* to) {  // at(i, column): the line, or the pixel, i away
    for (Index column = 0; column < columns; column += lanes) {
      const int here = static_cast<int>(std::min<Index>(lanes, columns - column));
      Floats sum = weights[0] * load(at(0, column), here);
      for (Index i = 1; i <= reach; ++i)
        sum += weights[std::size_t(i)] * (load(at(-i, column), here) + load(at(i, column), here));
      store(sum, to + column, here);
    }
  };
  Eigen::Array<float, 1, Eigen::Dynamic> padded = Eigen::Array<float, 1, Eigen::Dynamic>::Zero(columns + 2 * reach);
  for (Index row = 0; row < rows; ++row) {
    padded.segment(reach, columns) = plane.row(row);
    if (beyond == Beyond::same) {
      padded.head(reach).setConstant(plane(row, 0));
      padded.tail(reach).setConstant(plane(row, columns - 1));
    }
    blur_line([&](Index i, Index column) { return padded.data() + reach + column + i; }, scratch.row(row).data());
  }
  padded.setZero();  // a row beyond
  std::vector<const float*> around(static_cast<std::size_t>(2 * reach + 1));
  for (Index row = 0; row < rows; ++row) {
    for (Index i = -reach; i <= reach; ++i) {
      const Index from = beyond == Beyond::same ? std::clamp<Index>(row + i, 0, rows - 1) : row + i;
      around[static_cast<std::size_t>(reach + i)] = from >= 0 && from < rows ? scratch.row(from).data() : padded.data();
    }
    blur_line([&](Index i, Index column) { return around[static_cast<std::size_t>(reach + i)] + column; },
              plane.row(row).data());
  }
}

}  // namespace ostium::fluoro
