#include "data/identification/curves/set/curve_noise.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "core/math/dense.h"

namespace ostium::data::curves {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double normal_from_median = 1.4826;  // standard deviation of a normal law over its median distance
constexpr double far_off = 4;                  // standard errors that count as a difference
constexpr double drawn_in = 2.5;               // where Huber's loss turns from square to linear
constexpr double longest_share = 1.0 / 8;      // of a run: a correlation longer than that is no noise

double median_distance(std::vector<double> values) {
  if (values.empty()) return 0;
  for (double& v : values) v = std::fabs(v);
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Orthonormal slow shapes of a run: bends of the whole, and what there differs from back by.
MatrixXd slow_basis(const Run& run) {
  const Eigen::Index n = run.samples();
  Eigen::Index turn = 0;
  run.along.cwiseAbs().maxCoeff(&turn);
  const bool returns = turn > n / 5 && turn < n - n / 5;
  const Eigen::Index columns = std::min<Eigen::Index>(returns ? 6 : 4, n / 4);
  if (columns < 1) return MatrixXd(n, 0);
  MatrixXd shapes(n, columns);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double t = n > 1 ? 2.0 * static_cast<double>(k) / static_cast<double>(n - 1) - 1 : 0;
    const double side = k <= turn ? 1 : -1, all[] = {1, t, t * t, t * t * t, side, side * t};
    for (Eigen::Index c = 0; c < columns; ++c) shapes(k, c) = all[c];
  }
  return core::orthonormal(shapes);
}

/// What is left of a run's misfit without its slow shapes.
VectorXd quick(const Run& run, const VectorXd& misfit) {
  const MatrixXd Q = slow_basis(run);
  return misfit - Q * (Q.transpose() * misfit);
}

/// What a sample does not share with the one before, of variance 1 for noise of this size.
VectorXd alone(const VectorXd& misfit, const ChannelNoise& noise) {
  VectorXd out = misfit / noise.size;
  const double rho = noise.correlation, rest = std::sqrt(1 - rho * rho);
  for (Eigen::Index k = out.size() - 1; rho != 0 && k > 0; --k) out[k] = (out[k] - rho * out[k - 1]) / rest;
  return out;
}

/// What noise of one size and correlation leaves in the quick part of a run: the sum of squares, and of products of
/// neighbours.
struct Expected {
  double squares = 0, products = 0;
};
Expected expected(const Run& run, double rho) {
  const Eigen::Index n = run.samples();
  MatrixXd C(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) C(i, j) = std::pow(rho, std::abs(static_cast<double>(i - j)));
  const MatrixXd Q = slow_basis(run), left = C - Q * (Q.transpose() * C), both = left - (left * Q) * Q.transpose();
  return {both.trace(), both.diagonal(1).sum()};
}

/// The correlation whose noise would have this ratio of products to squares in the quick parts of the runs.
double correlation_for(const std::vector<Run>& runs, double ratio, double most) {
  double low = 0, high = most;
  for (int i = 0; i < 12; ++i) {
    const double middle = (low + high) / 2;
    Expected sum;
    for (const Run& run : runs) {
      const Expected e = expected(run, middle);
      sum.squares += e.squares, sum.products += e.products;
    }
    (sum.products / sum.squares < ratio ? low : high) = middle;
  }
  return (low + high) / 2;
}

ChannelNoise noise_of_channel(const std::vector<Run>& runs, const std::vector<Curves>& misfits, std::size_t channel,
                              bool declared) {
  double products = 0, squares = 0, count = 0, longest = 0;
  Expected independent;
  std::vector<Run> long_enough;
  std::vector<VectorXd> residuals;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const VectorXd e = quick(runs[r], misfits[r][channel]);
    const Eigen::Index n = e.size();
    if (n < 12) continue;
    long_enough.push_back(runs[r]);
    products += e.head(n - 1).dot(e.tail(n - 1)), squares += e.squaredNorm(), count += static_cast<double>(n);
    const Expected of_run = expected(runs[r], 0);
    independent.squares += of_run.squares, independent.products += of_run.products;
    longest = std::max(longest, longest_share * static_cast<double>(n));
    residuals.push_back(e);
  }
  ChannelNoise out;
  if (count < 20 || squares == 0) return out;
  const double ratio = products / squares, of_none = independent.products / independent.squares;
  if ((ratio - of_none) * std::sqrt(count) > far_off)
    out.correlation = correlation_for(long_enough, ratio, std::exp(-1 / std::max(longest, 0.5)));
  // Sizes and tails are those of what neighbours do not share.
  std::vector<double> all;
  double own = 0;
  for (const VectorXd& e : residuals)
    for (const double x : alone(e, {1, out.correlation, false})) all.push_back(x), own += x * x;
  const double fitted = std::sqrt(count / std::min(independent.squares, count));
  const double spread = fitted * std::sqrt(own / count), typical = fitted * normal_from_median * median_distance(all);
  double far = 0;
  for (const double e : all) far += std::fabs(e) > far_off * typical;
  out.heavy = far > std::max(3.0, 5e-3 * count);
  const double size = out.heavy ? typical : spread;
  const double uncertain = std::sqrt(0.5 / count);
  if (!declared || std::fabs(size - 1) > far_off * uncertain) out.size = size;
  return out;
}

}  // namespace

double worth(const ChannelNoise& noise, double samples) {
  return std::max(samples * (1 - noise.correlation) / (1 + noise.correlation), 1.0);
}

Noise declared_noise(std::vector<Run>& runs) {
  Noise out;
  if (runs.empty()) return out;
  out.channels.resize(runs[0].channels.size());
  for (std::size_t c = 0; c < out.channels.size(); ++c) {
    if (runs[0].channels[c].sigma.size() > 0) continue;
    out.declared = false;
    const double weights[] = {1, -4, 6, -4, 1}, norm = std::sqrt(70.0);
    std::vector<double> left;
    for (const Run& run : runs) {
      const VectorXd& y = run.channels[c].measured;
      for (Eigen::Index k = 0; k + 5 <= y.size(); ++k) {
        double sum = 0;
        for (Eigen::Index i = 0; i < 5; ++i) sum += weights[i] * y[k + i];
        left.push_back(sum / norm);
      }
    }
    const double sigma = normal_from_median * median_distance(left);
    for (Run& run : runs) {
      const double least = 1e-6 * std::max(run.channels[c].measured.cwiseAbs().maxCoeff(), 1e-12);
      run.channels[c].sigma = VectorXd::Constant(run.samples(), std::max(sigma, least));
    }
  }
  return out;
}

Noise noise_of(const std::vector<Run>& runs, const std::vector<Curves>& misfits, const Noise& declared) {
  Noise out = declared;
  for (std::size_t c = 0; c < out.channels.size(); ++c) {
    out.channels[c] = noise_of_channel(runs, misfits, c, declared.declared);
    const ChannelNoise& n = out.channels[c];
    if (declared.declared && (n.size != 1 || n.correlation != 0 || n.heavy)) out.as_declared = false;
  }
  return out;
}

VectorXd clipped(const VectorXd& misfit, const ChannelNoise& noise) {
  VectorXd out = alone(misfit, noise);
  if (noise.heavy) out = out.cwiseMax(-drawn_in).cwiseMin(drawn_in);
  return out;
}

VectorXd whitened(const VectorXd& misfit, const ChannelNoise& noise) {
  VectorXd out = alone(misfit, noise);
  if (noise.heavy)
    for (double& e : out)
      if (std::fabs(e) > drawn_in) e = std::copysign(std::sqrt(2 * drawn_in * std::fabs(e) - drawn_in * drawn_in), e);
  return out;
}

double slow_shapes(const std::vector<Run>& runs, const std::vector<Curves>& misfits, const Noise& noise,
                   double fitted_numbers) {
  double squares = 0, count = -fitted_numbers;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const MatrixXd Q = slow_basis(runs[r]);
    for (std::size_t c = 0; c < misfits[r].size(); ++c) {
      squares += (Q.transpose() * clipped(misfits[r][c], noise.channels[c])).squaredNorm();
      count += static_cast<double>(Q.cols());
    }
  }
  count = std::max(count, 1.0);
  return (squares - count) / std::sqrt(2 * count);
}

}  // namespace ostium::data::curves
