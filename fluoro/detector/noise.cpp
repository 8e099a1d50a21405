#include "fluoro/detector/noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

namespace ostium::fluoro {

namespace {

using Quantiles = std::array<float, 65536>;

/// Quantile of the standard normal distribution: Newton's method on its cumulative distribution.
double normal_quantile(double p) {
  double x = 0;
  for (int i = 0; i < 60; ++i) {
    const double error = 0.5 * std::erfc(-x / std::sqrt(2.0)) - p;
    const double density = std::exp(-0.5 * x * x) / std::sqrt(2 * 3.14159265358979323846);
    const double step = std::clamp(error / density, -0.5, 0.5);
    x -= step;
    if (std::fabs(step) < 1e-13) break;
  }
  return x;
}

std::unique_ptr<const Quantiles> make_quantiles() {
  auto table = std::make_unique<Quantiles>();
  const std::size_t half = table->size() / 2;
  double squares = 0;
  for (std::size_t i = 0; i < half; ++i) {
    const double x = normal_quantile((double(i) + 0.5) / double(table->size()));
    squares += x * x / double(half);
    (*table)[i] = static_cast<float>(x);
  }
  for (std::size_t i = 0; i < half; ++i) {
    (*table)[i] /= static_cast<float>(std::sqrt(squares));
    (*table)[table->size() - 1 - i] = -(*table)[i];
  }
  return table;
}

/// Two rounds of xor-shift and multiply: every bit of the input reaches every bit of the output.
std::uint32_t mixed(std::uint32_t x) {
  x = (x ^ (x >> 16)) * 0x7feb352dU;
  x = (x ^ (x >> 15)) * 0x846ca68bU;
  return x ^ (x >> 16);
}

}  // namespace

void count_photons(const NoiseKey& key, const Arriving& in, Plane& out) {
  static const std::unique_ptr<const Quantiles> quantiles = make_quantiles();
  const auto fold = [](std::uint64_t x) {
    return mixed(std::uint32_t(x) ^ mixed(std::uint32_t(x >> 32) + 0x9e3779b9U));
  };
  const std::uint32_t frame = mixed(fold(key.seed) + 0x85ebca6bU * fold(key.frame + 1));
  const auto per_keV = static_cast<float>(in.photons / in.unit_keV);
  const auto per_keV2 = static_cast<float>(in.photons / (in.unit_keV * in.unit_keV * in.swank));
  const Eigen::Index columns = in.signal_keV.cols();
  out.resize(in.signal_keV.rows(), columns);
  Eigen::Array<float, 1, Eigen::Dynamic> deviates(columns);
  for (Eigen::Index row = 0; row < in.signal_keV.rows(); ++row) {
    const std::uint32_t start = mixed(frame + 0xc2b2ae35U * static_cast<std::uint32_t>(row));
    for (Eigen::Index column = 0; column < columns; ++column)
      deviates[column] = (*quantiles)[mixed(start + 0x9e3779b9U * static_cast<std::uint32_t>(column)) >> 16];
    const auto signal = in.signal_keV.row(row), scatter = in.scatter_keV.row(row);
    out.row(row) = (per_keV * (signal + scatter) +
                    (per_keV2 * in.variance_keV2.row(row) * (1 + scatter / signal.max(1e-20f))).sqrt() * deviates)
                       .max(0.0f);
  }
}

}  // namespace ostium::fluoro
