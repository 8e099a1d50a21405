#include "data/identification/residuals/noise_model.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <cmath>

#include "core/base/units.h"
#include "core/math/dense.h"

namespace ostium::data {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double few_points = 30;  // leave correlation and tails open
constexpr int lengths_tried = 14;
constexpr double whites_tried[] = {0, 0.1, 0.3, 0.6};
constexpr double most_white = 0.95, least_white = 1e-3;  // smooth correlations alone are singular
constexpr double degrees_tried[] = {2, 3, 5, 10};
constexpr double longest_share = 0.5;  // of a trace: what is shared farther than that is its mean
constexpr int scale_rounds = 40;

double points_of(const std::vector<ResidualTrace>& traces) {
  double n = 0;
  for (const ResidualTrace& t : traces) n += static_cast<double>(t.values.rows());
  return n;
}

double numbers_of(const std::vector<ResidualTrace>& traces) {
  double n = 0;
  for (const ResidualTrace& t : traces) n += t.numbers * static_cast<double>(t.values.rows());
  return n;
}

double shared(double lengths, bool smooth) { return smooth ? std::exp(-lengths * lengths / 2) : std::exp(-lengths); }

MatrixXd correlations(const VectorXd& at, const NoiseModel& m) {
  const Eigen::Index n = at.size();
  MatrixXd R = MatrixXd::Identity(n, n);
  for (Eigen::Index i = 0; i < n && m.correlated(); ++i)
    for (Eigen::Index j = 0; j < i; ++j)
      R(i, j) = R(j, i) = (1 - m.white) * shared(std::fabs(at[i] - at[j]) / m.length, m.smooth);
  return R;
}

/// Decorrelated, in units of sigma 1, and the log determinant of the correlations.
struct Decorrelated {
  std::vector<VectorXd> squares;  ///< per trace and point
  double log_det = 0;             ///< counted once a component
};

MatrixXd decorrelate(const ResidualTrace& t, const NoiseModel& m, double* log_det = nullptr) {
  if (!m.correlated()) return t.values;
  const MatrixXd L = core::cholesky(correlations(t.at, m));
  if (log_det) *log_det += 2 * L.diagonal().array().log().sum() * t.numbers;
  return core::solve_lower(L, t.values);
}

Decorrelated all_decorrelated(const std::vector<ResidualTrace>& traces, const NoiseModel& m) {
  Decorrelated out;
  for (const ResidualTrace& t : traces)
    out.squares.emplace_back(decorrelate(t, m, &out.log_det).rowwise().squaredNorm());
  return out;
}

/// The scale of most likelihood: a fixed point, in which far points count the less the heavier the tails.
double sigma_of(const std::vector<ResidualTrace>& traces, const Decorrelated& d, double degrees) {
  const double n = numbers_of(traces);
  double variance = 0;
  for (const VectorXd& s : d.squares) variance += s.sum() / n;
  for (int round = 0; std::isfinite(degrees) && round < scale_rounds; ++round) {
    double next = 0;
    for (std::size_t i = 0; i < traces.size(); ++i)
      for (const double s : d.squares[i])
        next += (degrees + traces[i].numbers) / (degrees + s / std::max(variance, 1e-300)) * s / n;
    variance = next;
  }
  return std::sqrt(variance);
}

/// Minus twice the log of a point's density beyond the normal's or t's constant part: what grows with its square.
double cost_of(double square, double numbers, double degrees) {
  return std::isfinite(degrees) ? (degrees + numbers) * std::log1p(square / degrees) : square;
}

/// std::lgamma for any number of threads: that one keeps its sign in a global.
double log_gamma(double x) {
  int sign = 0;
  return lgamma_r(x, &sign);
}

double constant_of(double numbers, double degrees) {
  if (!std::isfinite(degrees)) return numbers * std::log(2 * units::pi);
  return -2 * (log_gamma((degrees + numbers) / 2) - log_gamma(degrees / 2)) + numbers * std::log(degrees * units::pi);
}

/// The derivative of log Gamma, to eight figures.
double digamma(double x) {
  constexpr double step = 1e-4;
  return (log_gamma(x + step) - log_gamma(x - step)) / (2 * step);
}

double likelihood_of(const std::vector<ResidualTrace>& traces, const Decorrelated& d, const NoiseModel& m) {
  double out = d.log_det + 2 * numbers_of(traces) * std::log(std::max(m.sigma, 1e-300));
  for (std::size_t i = 0; i < traces.size(); ++i)
    for (const double s : d.squares[i])
      out += cost_of(s / (m.sigma * m.sigma), traces[i].numbers, m.degrees) + constant_of(traces[i].numbers, m.degrees);
  return out;
}

struct Candidate {
  NoiseModel model;
  double bic = std::numeric_limits<double>::infinity();
};

/// Fits sigma of a model whose other numbers are given, and keeps it if it is better.
void try_out(const std::vector<ResidualTrace>& traces, const Decorrelated& d, NoiseModel m, double numbers_fitted,
             Candidate& best) {
  m.sigma = sigma_of(traces, d, m.degrees);
  const double bic = likelihood_of(traces, d, m) + numbers_fitted * std::log(numbers_of(traces));
  if (bic < best.bic) best = {m, bic};
}

/// Length and white part between those that were tried: where noise is smooth, its size hangs on them.
void refine(const std::vector<ResidualTrace>& traces, double numbers_fitted, Candidate& best) {
  if (!best.model.correlated()) return;
  for (const double step : {1.5, 1.2, 1.5, 1.2, 1.1, 1.05})
    for (const double factor : {step, 1 / step}) {
      NoiseModel longer = best.model, whiter = best.model;
      longer.length *= factor;
      try_out(traces, all_decorrelated(traces, longer), longer, numbers_fitted, best);
      whiter.white = std::min(whiter.white * factor * factor, most_white);
      if (whiter.white > 0) try_out(traces, all_decorrelated(traces, whiter), whiter, numbers_fitted, best);
    }
}

/// Longest distance along a trace, and the mean one between neighbours.
std::pair<double, double> spans(const std::vector<ResidualTrace>& traces) {
  double longest = 0, sum = 0, pairs = 0;
  for (const ResidualTrace& t : traces) {
    if (t.at.size() < 2) continue;
    const double span = std::fabs(t.at[t.at.size() - 1] - t.at[0]);
    longest = std::max(longest, span), sum += span, pairs += static_cast<double>(t.at.size() - 1);
  }
  return {longest, pairs > 0 ? sum / pairs : 0};
}

}  // namespace

NoiseModel noise_model_of(const std::vector<ResidualTrace>& traces, std::optional<double> declared, double strong) {
  std::vector<Candidate> simplest_first;
  const Decorrelated plain = all_decorrelated(traces, {});
  if (declared) {
    NoiseModel m;
    m.sigma = *declared, m.as_declared = true;
    simplest_first.push_back({m, likelihood_of(traces, plain, m)});
  }
  const bool enough = points_of(traces) >= few_points;
  if (declared && !enough) return simplest_first.front().model;
  Candidate sized, heavy, correlated, both;
  try_out(traces, plain, {}, 1, sized);
  for (const double degrees : degrees_tried) {
    NoiseModel m;
    m.degrees = degrees;
    if (enough) try_out(traces, plain, m, 2, heavy);
  }
  const auto [longest, spacing] = spans(traces);
  for (int k = 0; enough && longest > 2 * spacing && k < lengths_tried; ++k)
    for (int kind = 0; kind < 2 * static_cast<int>(std::size(whites_tried)); ++kind) {
      NoiseModel m;
      m.smooth = kind % 2 == 1;
      const double white = std::max(whites_tried[kind / 2], m.smooth ? least_white : 0.0);
      m.length = spacing / 2 * std::pow(2 * longest_share * longest / spacing, k / (lengths_tried - 1.0));
      m.white = white;
      const Decorrelated d = all_decorrelated(traces, m);
      const double more = white > 0 ? 1 : 0;
      try_out(traces, d, m, 2 + more, correlated);
      for (const double degrees : degrees_tried) {
        m.degrees = degrees;
        try_out(traces, d, m, 3 + more, both);
      }
    }
  refine(traces, correlated.model.white > 0 ? 3 : 2, correlated);
  refine(traces, both.model.white > 0 ? 4 : 3, both);
  for (const Candidate& c : {sized, heavy, correlated, both}) simplest_first.push_back(c);
  const Candidate* chosen = &simplest_first.front();
  for (const Candidate& c : simplest_first)
    if (c.bic < chosen->bic - strong) chosen = &c;
  return chosen->model;
}

Decorrelator::Decorrelator(const VectorXd& at, double numbers, const NoiseModel& model)
    : model_(model), numbers_(numbers) {
  if (model.correlated()) factor_ = core::cholesky(correlations(at, model));
}

MatrixXd Decorrelator::operator()(const MatrixXd& values) const {
  MatrixXd out = values / model_.sigma;
  if (factor_.size() > 0) out = core::solve_lower(factor_, out);
  for (Eigen::Index i = 0; model_.heavy() && i < out.rows(); ++i) {
    const double square = out.row(i).squaredNorm();
    if (square > 0) out.row(i) *= std::sqrt(cost_of(square, numbers_, model_.degrees) / square);
  }
  return out;
}

MatrixXd decorrelated(const ResidualTrace& t, const NoiseModel& m) {
  return Decorrelator(t.at, t.numbers, m)(t.values);
}

double expected_square(const NoiseModel& m, double numbers) {
  if (!m.heavy()) return 1;
  return (m.degrees + numbers) * (digamma((m.degrees + numbers) / 2) - digamma(m.degrees / 2)) / numbers;
}

double minus_two_log_likelihood(const std::vector<ResidualTrace>& traces, const NoiseModel& m) {
  return likelihood_of(traces, all_decorrelated(traces, m), m);
}

double own_noise_cost(const std::vector<ResidualTrace>& traces, std::optional<double> declared) {
  const NoiseModel m = noise_model_of(traces, declared);
  const double fitted = m.as_declared ? 0 : 1 + m.heavy() + m.correlated() + (m.correlated() && m.white > 0);
  return minus_two_log_likelihood(traces, m) + fitted * std::log(numbers_of(traces));
}

double effective_numbers(const std::vector<ResidualTrace>& traces, const NoiseModel& m) {
  double out = 0;
  for (const ResidualTrace& t : traces) {
    const auto n = static_cast<double>(t.values.rows());
    out += t.numbers * (m.correlated() ? n * n / correlations(t.at, m).sum() : n);
  }
  return out;
}

std::string doubt_of_noise(double chi2_per_dof, double degrees_of_freedom) {
  constexpr double far = 0.1, enough = 10;  // noise three times too large; so many leave so little once in 5000 times
  if (!(chi2_per_dof < far) || chi2_per_dof <= 0 || degrees_of_freedom < enough) return "";
  return fmt::format(
      "Suspicious: the noise that is declared is {:.3g} times what is left. Is its unit right? As it stands, nothing "
      "that is smaller can be told.",
      1 / std::sqrt(chi2_per_dof));
}

std::string in_words(const NoiseModel& m, std::optional<double> declared, double unit, const std::string& name) {
  std::string out = fmt::format("{:.3g} {}", m.sigma / unit, name);
  if (declared && std::fabs(m.sigma / *declared - 1) > 0.1)
    out += fmt::format(", {:.2g} times what is declared", m.sigma / *declared);
  if (m.correlated()) out += fmt::format(", shared by neighbours over {:.2g} {}", m.length / unit, name);
  if (m.heavy())
    out += fmt::format(", with far more outlying points than a normal one (Student's t of {:g})", m.degrees);
  return out;
}

}  // namespace ostium::data
