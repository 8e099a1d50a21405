#include "data/picture/image.h"

#include <algorithm>
#include <cmath>

#include "core/base/quantile.h"

namespace ostium::data {

using Eigen::Index;

namespace {

/// Weights from -reach to reach.
std::vector<double> kernel(double sigma, int order) {
  const int reach = static_cast<int>(4 * sigma + 0.5);
  const double s2 = sigma * sigma;
  std::vector<double> w;
  double sum = 0;
  for (int n = -reach; n <= reach; ++n) sum += w.emplace_back(std::exp(-0.5 * n * n / s2));
  for (int n = -reach; n <= reach; ++n) {
    double& x = w[static_cast<std::size_t>(n + reach)];
    x *= (order == 0 ? 1 : order == 1 ? n / s2 : n * n / (s2 * s2) - 1 / s2) / sum;
  }
  return w;
}

/// Index of a position beyond the ends, mirrored about the edge.
Index mirrored_at(Index i, Index n) {
  const Index m = ((i % (2 * n)) + 2 * n) % (2 * n);
  return m < n ? m : 2 * n - 1 - m;
}

Image along_rows(const Image& image, const std::vector<double>& w) {
  const Index reach = static_cast<Index>(w.size() / 2), n = image.cols();
  Image out = Image::Zero(image.rows(), n);
  Eigen::Array<double, 1, Eigen::Dynamic> padded(n + 2 * reach);
  for (Index row = 0; row < image.rows(); ++row) {
    for (Index i = 0; i < padded.size(); ++i) padded[i] = image(row, mirrored_at(i - reach, n));
    for (std::size_t k = 0; k < w.size(); ++k) out.row(row) += w[k] * padded.segment(static_cast<Index>(k), n);
  }
  return out;
}

Image along_columns(const Image& image, const std::vector<double>& w) {
  const Index reach = static_cast<Index>(w.size() / 2), n = image.rows();
  Image out = Image::Zero(n, image.cols());
  for (Index row = 0; row < n; ++row)
    for (std::size_t k = 0; k < w.size(); ++k)
      out.row(row) += w[k] * image.row(mirrored_at(row + static_cast<Index>(k) - reach, n));
  return out;
}

}  // namespace

Image to_measured_side(const Image& image) {
  const Index k = std::min(image.rows(), image.cols()), side = measured_side;
  const Image square = image.block((image.rows() - k) / 2, (image.cols() - k) / 2, k, k);
  if (k == side) return square;
  Image out(side, side);
  if (k % side == 0) {
    const Index each = k / side;
    for (Index y = 0; y < side; ++y)
      for (Index x = 0; x < side; ++x) out(y, x) = square.block(y * each, x * each, each, each).mean();
    return out;
  }
  const double per = static_cast<double>(k - 1) / (side - 1), blur = 0.4 * (static_cast<double>(k) / side - 1);
  const Image smooth = blur > 0 ? gaussian(square, blur) : square;
  for (Index y = 0; y < side; ++y)
    for (Index x = 0; x < side; ++x)
      out(y, x) = sample(smooth, per * static_cast<double>(y), per * static_cast<double>(x));
  return out;
}

Image gaussian(const Image& image, double sigma, int order_y, int order_x) {
  return along_rows(along_columns(image, kernel(sigma, order_y)), kernel(sigma, order_x));
}

std::vector<double> gaussian(const std::vector<double>& values, double sigma, bool mirrored) {
  const std::vector<double> w = kernel(sigma, 0);
  const Index reach = static_cast<Index>(w.size() / 2), n = static_cast<Index>(values.size());
  std::vector<double> out(values.size(), 0.0);
  for (Index i = 0; i < n; ++i)
    for (Index k = -reach; k <= reach; ++k) {
      const Index at = mirrored ? mirrored_at(i + k, n) : std::clamp<Index>(i + k, 0, n - 1);
      out[static_cast<std::size_t>(i)] += w[static_cast<std::size_t>(k + reach)] * values[static_cast<std::size_t>(at)];
    }
  return out;
}

Image gradient(const Image& image, double sigma) {
  return (gaussian(image, sigma, 1, 0).square() + gaussian(image, sigma, 0, 1).square()).sqrt();
}

double sample(const Image& image, double y, double x) {
  const double yy = std::clamp(y, 0.0, static_cast<double>(image.rows() - 1)),
               xx = std::clamp(x, 0.0, static_cast<double>(image.cols() - 1));
  const Index y0 = std::min<Index>(static_cast<Index>(yy), image.rows() - 2),
              x0 = std::min<Index>(static_cast<Index>(xx), image.cols() - 2);
  const double fy = yy - static_cast<double>(y0), fx = xx - static_cast<double>(x0);
  return (1 - fy) * ((1 - fx) * image(y0, x0) + fx * image(y0, x0 + 1)) +
         fy * ((1 - fx) * image(y0 + 1, x0) + fx * image(y0 + 1, x0 + 1));
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

double deviation(const std::vector<double>& values) {
  const double middle = mean(values);
  double sum = 0;
  for (double v : values) sum += (v - middle) * (v - middle);
  return std::sqrt(sum / static_cast<double>(values.size()));
}

double robust_deviation(const std::vector<double>& values) {
  const double middle = core::median(values);
  std::vector<double> from;
  for (double v : values) from.push_back(std::fabs(v - middle));
  return 1.4826 * core::median(std::move(from));
}

std::vector<double> values_in(const Image& image, const Mask& mask) {
  std::vector<double> out;
  for (Index i = 0; i < image.size(); ++i)
    if (mask.data()[i]) out.push_back(image.data()[i]);
  return out;
}

}  // namespace ostium::data
