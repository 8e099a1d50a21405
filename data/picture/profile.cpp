#include "data/picture/profile.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/quantile.h"

namespace ostium::data {

namespace {

constexpr double step_px = 0.5;

/// Depth below a straight line through the medians of both ends.
struct Dip {
  std::size_t middle = 0;
  std::vector<double> depth;
  double background = 0, left = 0, right = 0;
};

std::optional<Dip> dip_of(const Across& a) {
  Dip out;
  const std::vector<double>&u = a.offset_px, &v = a.grey;
  double least = 1e9;
  for (std::size_t i = 0; i < u.size(); ++i)
    if (std::fabs(u[i]) < 4 && v[i] < least) least = v[i], out.middle = i;
  std::array<std::vector<double>, 2> at, grey;
  for (std::size_t i = 0; i < u.size(); ++i)
    if (const double from = u[i] - u[out.middle]; std::fabs(from) > 0.72 * u.back())
      at[from > 0].push_back(u[i]), grey[from > 0].push_back(v[i]);
  if (at[0].size() < 3 || at[1].size() < 3) return {};
  out.left = core::median(grey[0]), out.right = core::median(grey[1]);
  const double from = mean(at[0]), slope = (out.right - out.left) / (mean(at[1]) - from);
  for (std::size_t i = 0; i < u.size(); ++i) out.depth.push_back(out.left + slope * (u[i] - from) - v[i]);
  out.background = out.left + slope * (u[out.middle] - from);
  return out;
}

/// Distance from the middle to where the dip has come up to that depth on one side; negative: nowhere.
double rise(const Across& a, const Dip& dip, double level, int side) {
  auto i = static_cast<std::ptrdiff_t>(dip.middle);
  const auto last = static_cast<std::ptrdiff_t>(dip.depth.size()) - 1;
  while (i > 0 && i < last && dip.depth[static_cast<std::size_t>(i)] > level) i += side;
  if (i == 0 || i == last) return -1;
  const auto at = static_cast<std::size_t>(i), before = static_cast<std::size_t>(i - side);
  const double share = (dip.depth[before] - level) / std::max(dip.depth[before] - dip.depth[at], 1e-9);
  return std::fabs(a.offset_px[before] + side * step_px * share - a.offset_px[dip.middle]);
}

/// Chords of a circle of that diameter over it, blurred; at offsets every quarter pixel about its middle.
struct Shadow {
  static constexpr double each = 0.25, reach = 40;
  std::vector<double> value;
  Shadow(double diameter, double blur) {
    for (double x = -reach; x <= reach + 0.01; x += each)
      value.push_back(2 * std::sqrt(std::max(0.25 * diameter * diameter - x * x, 0.0)) / diameter);
    value = gaussian(value, std::max(blur, 0.05) / each, true);
  }
  double at(double x) const {
    const double i = std::clamp((x + reach) / each, 0.0, static_cast<double>(value.size() - 1));
    const std::size_t low = std::min(static_cast<std::size_t>(i), value.size() - 2);
    const double share = i - static_cast<double>(low);
    return (1 - share) * value[low] + share * value[low + 1];
  }
};

}  // namespace

Across across(const Image& image, const Eigen::Vector2d& at, const Eigen::Vector2d& along, double half) {
  Across out;
  const Eigen::Vector2d normal(along[1], -along[0]);
  for (double u = -half; u <= half + 0.01; u += step_px) {
    double sum = 0;
    for (int k = -3; k <= 3; ++k) {
      const Eigen::Vector2d p = at + u * normal + k * along;
      sum += sample(image, p[0], p[1]);
    }
    out.offset_px.push_back(u), out.grey.push_back(sum / 7);
  }
  return out;
}

std::optional<Profile> measure(const Across& a) {
  const std::optional<Dip> dip = dip_of(a);
  if (!dip) return {};
  Profile out;
  const std::size_t from = dip->middle ? dip->middle - 1 : 0, to = std::min(dip->middle + 2, dip->depth.size());
  for (std::size_t i = from; i < to; ++i) out.depth += dip->depth[i] / static_cast<double>(to - from);
  if (out.depth < 3 || std::fabs(dip->right - dip->left) > 1.8 * out.depth) return {};
  std::array<double, 2> edge;
  for (int side : {-1, 1}) {
    const double low = rise(a, *dip, 0.1 * out.depth, side), half = rise(a, *dip, 0.5 * out.depth, side),
                 high = rise(a, *dip, 0.9 * out.depth, side);
    if (low < 0 || half < 0 || high < 0) return {};
    out.width_px += half;
    edge[side > 0] = low - high;
  }
  if (out.width_px > 0.9 * a.offset_px.back()) return {};
  if (std::max(edge[0], edge[1]) > 3 * std::min(edge[0], edge[1]) + 2) return {};
  out.background = dip->background;
  return out;
}

std::optional<double> fitted_blur(const Across& a, const Profile& start) {
  const std::optional<Dip> dip = dip_of(a);
  if (!dip) return {};
  using Six = Eigen::Matrix<double, 6, 1>;  // depth, middle, diameter, blur, offset and slope of the background
  std::vector<std::size_t> used;
  for (std::size_t i = 0; i < a.offset_px.size(); ++i)
    if (std::fabs(a.offset_px[i] - a.offset_px[dip->middle]) < start.width_px + 6) used.push_back(i);
  const auto residual = [&](const Six& z) {
    const Shadow shadow(std::fabs(z[2]), std::fabs(z[3]));
    Eigen::VectorXd out(static_cast<Eigen::Index>(used.size()));
    for (std::size_t k = 0; k < used.size(); ++k) {
      const double u = a.offset_px[used[k]];
      out[static_cast<Eigen::Index>(k)] = z[0] * shadow.at(u - z[1]) + z[4] + z[5] * u - dip->depth[used[k]];
    }
    return out;
  };
  Six z;
  z << 1.1 * start.depth, a.offset_px[dip->middle], 1.1 * start.width_px, 1.2, 0, 0;
  Eigen::VectorXd r = residual(z);
  double damping = 1e-3;
  for (int pass = 0; pass < 25; ++pass) {
    Eigen::MatrixXd slope(r.size(), 6);
    for (int k = 0; k < 6; ++k) {
      Six moved = z;
      const double h = 1e-4 * std::max(1.0, std::fabs(z[k]));
      moved[k] += h;
      slope.col(k) = (residual(moved) - r) / h;
    }
    const Eigen::Matrix<double, 6, 6> square = slope.transpose() * slope;
    Eigen::Matrix<double, 6, 6> damped = square;
    damped.diagonal() += damping * (square.diagonal().array() + 1e-9).matrix();
    const Six next = z - damped.ldlt().solve(slope.transpose() * r);
    const Eigen::VectorXd after = residual(next);
    if (after.squaredNorm() < r.squaredNorm())
      z = next, r = after, damping *= 0.3;
    else
      damping *= 5;
  }
  const double misfit = std::sqrt(r.squaredNorm() / static_cast<double>(r.size())) / start.depth;
  if (misfit >= 0.08) return {};
  return std::fabs(z[3]);
}

}  // namespace ostium::data
