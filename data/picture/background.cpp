#include "data/picture/background.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <unsupported/Eigen/FFT>

#include "core/base/quantile.h"

namespace ostium::data {

using Eigen::Index;

namespace {

/// Power by frequency: 24 rings from 0.008 to 0.5 cycles a pixel, evenly spaced in the logarithm. `square`: as many
/// rows as columns.
struct Spectrum {
  static constexpr int rings = 24;
  static constexpr double least = 0.008, most = 0.5;
  std::array<double, rings> frequency{}, power{};
  std::array<int, rings> count{};

  explicit Spectrum(Image square) {
    const Index n = square.rows();
    square -= gaussian(square, static_cast<double>(n) / 5);
    square -= square.mean();
    Eigen::ArrayXd window(n);
    for (Index i = 0; i < n; ++i)
      window[i] = 0.5 - 0.5 * std::cos(2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n - 1));
    Eigen::FFT<double> fft;
    Eigen::MatrixXcd rows(n, n);
    for (Index y = 0; y < n; ++y) {
      Eigen::VectorXcd from = (square.row(y).transpose() * window * window[y]).matrix().cast<std::complex<double>>(),
                       to;
      fft.fwd(to, from);
      rows.row(y) = to.transpose();
    }
    const double per_ring = std::log(most / least) / rings;
    for (Index x = 0; x < n; ++x) {
      Eigen::VectorXcd from = rows.col(x), to;
      fft.fwd(to, from);
      for (Index y = 0; y < n; ++y) {
        const auto cycles = [&](Index i) { return static_cast<double>(std::min(i, n - i)) / static_cast<double>(n); };
        const double f = std::hypot(cycles(x), cycles(y));
        if (f < least || f >= most) continue;
        const auto ring = static_cast<std::size_t>(std::min(rings - 1.0, std::log(f / least) / per_ring));
        power[ring] += std::norm(to[y]), ++count[ring];
      }
    }
    for (std::size_t i = 0; i < rings; ++i) {
      frequency[i] = least * std::exp((static_cast<double>(i) + 0.5) * per_ring);
      if (count[i]) power[i] /= count[i];
    }
  }

  double slope(double from, double to) const {
    std::vector<double> x, y;
    for (std::size_t i = 0; i < rings; ++i)
      if (frequency[i] >= from && frequency[i] <= to && power[i] > 0)
        x.push_back(std::log(frequency[i])), y.push_back(std::log(power[i]));
    const double mx = mean(x), my = mean(y);
    double up = 0, across = 0;
    for (std::size_t i = 0; i < x.size(); ++i) up += (x[i] - mx) * (y[i] - my), across += (x[i] - mx) * (x[i] - mx);
    return up / across;
  }
};

}  // namespace

Image without_vessels(const Image& image, const Mask& vessels) {
  const Image weight = (!vessels).cast<double>(), seen = image * weight;
  const Image share = gaussian(weight, 6), near = gaussian(seen, 6) / share.max(1e-3),
              far = gaussian(seen, 20) / gaussian(weight, 20).max(1e-3);
  return vessels.select((share > 0.02).select(near, far), image);
}

Background measure_background(const Image& image, const Mask& vessels, const Mask& inner) {
  const Mask look = inner && !vessels;
  const Image b = without_vessels(image, vessels);
  Background out;
  const std::vector<double> grey = values_in(image, look), steep = values_in(gradient(b, 2), look);
  const double spread = core::quantile(grey, 0.95) - core::quantile(grey, 0.05), middle = core::median(steep);
  out.grad_median_rel = 100 * middle / std::max(spread, 1e-6);
  out.grad_p99_over_median = core::quantile(steep, 0.99) / std::max(middle, 1e-6);
  const auto detail = [&](double fine, double coarse) {
    return robust_deviation(values_in(gaussian(b, fine) - gaussian(b, coarse), look));
  };
  out.band32_mad = detail(16, 32);
  out.texture_ratio = detail(4, 8) / std::max(out.band32_mad, 1e-6);
  const Index margin = b.rows() / 10;
  out.psd_slope_noise =
      Spectrum(b.block(margin, margin, b.rows() - 2 * margin, b.cols() - 2 * margin)).slope(0.2, 0.45);
  return out;
}

Grain measure_grain(const Image& image, const Mask& look) {
  constexpr Index side = 24;
  const Image fine = image - gaussian(image, 3);
  struct Block {
    double grey, finest, deviation, to_the_right, below;
  };
  std::vector<Block> blocks;
  for (Index y = 0; y + side <= image.rows(); y += side)
    for (Index x = 0; x + side <= image.cols(); x += side) {
      if (!look.block(y, x, side, side).all()) continue;
      Image z = fine.block(y, x, side, side);
      z -= z.mean();
      const double variance = z.square().mean();
      if (variance <= 0) continue;
      // The finest grain: second differences both ways.
      Image n(side, side);
      for (Index v = 0; v < side; ++v)
        for (Index u = 0; u < side; ++u) {
          double sum = 0;
          for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx)
              sum += (dy ? 1 : -2) * (dx ? 1 : -2) *
                     image(std::clamp<Index>(y + v + dy, 0, image.rows() - 1),
                           std::clamp<Index>(x + u + dx, 0, image.cols() - 1));
          n(v, u) = sum / 6;
        }
      blocks.push_back({image.block(y, x, side, side).mean(), std::sqrt((n - n.mean()).square().mean()),
                        std::sqrt(variance), (z.rightCols(side - 1) * z.leftCols(side - 1)).mean() / variance,
                        (z.bottomRows(side - 1) * z.topRows(side - 1)).mean() / variance});
    }
  Grain out;
  if (blocks.size() < 12) return out;
  out.enough = true;
  const auto of = [&](double Block::*member) {
    std::vector<double> values;
    for (const Block& b : blocks) values.push_back(b.*member);
    return values;
  };
  const double flat = core::quantile(of(&Block::deviation), 0.40), dark = core::quantile(of(&Block::grey), 0.33),
               light = core::quantile(of(&Block::grey), 0.67);
  std::vector<double> relative, next, in_dark, in_light;
  for (const Block& b : blocks) {
    if (b.deviation <= flat) {
      relative.push_back(100 * b.deviation / b.grey);
      next.push_back(b.to_the_right), next.push_back(b.below);
    }
    if (b.grey <= dark) in_dark.push_back(b.finest);
    if (b.grey >= light) in_light.push_back(b.finest);
  }
  out.noise_rel = core::median(relative), out.grain = core::median(next);
  out.noise_dark_over_light = core::median(in_dark) / std::max(core::median(in_light), 1e-9);
  return out;
}

int border_sides(const Image& image) {
  const Index n = image.rows(), from = n / 4, count = n / 2;
  int sides = 0;
  for (int side = 0; side < 4; ++side) {
    std::vector<double> line;
    for (Index i = 0; i < 160; ++i) {
      const Index at = side % 2 ? n - 1 - i : i;
      line.push_back(side < 2 ? image.row(at).segment(from, count).mean() : image.col(at).segment(from, count).mean());
    }
    const double outermost = (line[0] + line[1] + line[2]) / 3;
    sides += outermost < 0.72 * core::median({line.begin() + 60, line.end()});
  }
  return sides;
}

}  // namespace ostium::data
