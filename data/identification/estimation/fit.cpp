#include "data/identification/estimation/fit.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/math/dense.h"
#include "data/identification/estimation/fit_problem.h"
#include "data/identification/estimation/measured_push.h"
#include "data/identification/forward/misfit.h"

namespace ostium::data {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double rough_tolerance = 1e-5;
constexpr int rough_iterations = 25;
constexpr std::size_t tasted = 3;  // starts of each group that are tried for a few iterations
constexpr int taste_iterations = 4;

/// The cost at a point, and the point.
using Start = std::pair<double, VectorXd>;

/// The starts sorted by cost, without those that have no shapes.
std::vector<Start> screened(const FitProblem& problem, const std::vector<VectorXd>& starts) {
  std::vector<Start> out;
  for (const VectorXd& start : starts) {
    const VectorXd x = problem.least_squares(start).start;
    VectorXd r;
    if (problem.evaluate(x, r, nullptr)) out.emplace_back(r.squaredNorm() / 2, x);
  }
  std::stable_sort(out.begin(), out.end(), [](const Start& a, const Start& b) { return a.first < b.first; });
  return out;
}

LeastSquaresResult descend(const FitProblem& problem, const VectorXd& start, bool rough, int most_iterations) {
  LeastSquares descent = problem.least_squares(start);
  if (rough) descent.tolerance = rough_tolerance, descent.most_iterations = most_iterations;
  if (problem.in_vessel()) return minimise(problem.by_secants(descent, rough));
  return minimise(descent);
}

/// Sorts the starts by cost and descends from the best ones.
LeastSquaresResult best_of(const FitProblem& problem, const FitOptions& options, const std::vector<VectorXd>& starts,
                           const std::vector<VectorXd>& other_starts) {
  std::vector<Start> from = screened(problem, starts);
  if (!other_starts.empty()) {
    std::vector<Start> ahead;
    for (const std::vector<Start>& sort : {from, screened(problem, other_starts)})
      for (std::size_t k = 0; k < std::min(tasted, sort.size()); ++k) {
        const LeastSquaresResult a_few_steps_on = descend(problem, sort[k].second, true, taste_iterations);
        ahead.emplace_back(a_few_steps_on.cost, a_few_steps_on.x);
      }
    from = ahead;
    std::stable_sort(from.begin(), from.end(), [](const Start& a, const Start& b) { return a.first < b.first; });
  }
  if (from.empty()) throw std::runtime_error("no static shape was found at the parameters a fit starts from");
  std::optional<LeastSquaresResult> best;
  for (std::size_t k = 0; k < std::min(from.size(), options.descents); ++k) {
    const LeastSquaresResult found = descend(problem, from[k].second, options.rough, rough_iterations);
    if (!best || found.cost < best->cost * (1 - 1e-9)) best = found;
  }
  return *best;
}

}  // namespace

double Fit::informed(int i) const {
  return std::clamp(1 - covariance(i, i) / (prior_sigma[i] * prior_sigma[i]), 0.0, 1.0);
}

Fit fit(const ForwardModel& forward, const Parameters& parameters, const FitOptions& options) {
  Fit out;
  const bool pushes = push_sigma_N(forward.set()).has_value();
  for (int e : options.experiments) {
    const Experiment& experiment = forward.set().experiments[e];
    out.measured += static_cast<double>(numbers_measured(experiment)) + (pushes && experiment.proximal_force_N ? 1 : 0);
  }
  std::vector<VectorXd> starts = options.starts, other_starts = options.other_starts;
  // If the noise is unknown, it is estimated from the residuals. The weight of the priors depends on it, so this takes
  // a few rounds.
  double sigma = options.sigma_m.value_or(options.guess_m);
  const int rounds = options.sigma_m ? 1 : options.rounds;
  for (int round = 0; round < rounds; ++round) {
    FitProblem problem(forward, parameters, options.experiments, {sigma, options.noise},
                       options.rough || forward.set().vessel);
    const LeastSquaresResult found = best_of(problem, options, starts, other_starts);
    VectorXd r;
    MatrixXd J;
    if (options.only_x && options.sigma_m) {
      out.x = found.x;
      return out;
    }
    if (!problem.evaluate(found.x, r, &J)) throw std::runtime_error("no static shape was found where a fit ended");
    if (problem.in_vessel() && !options.rough) {
      problem.widen_to_noise(J);
      if (!problem.evaluate(found.x, r, &J)) throw std::runtime_error("no shape was found next to where a fit ended");
    }
    const int n = problem.data_rows();
    const MatrixXd JtJ = J.transpose() * J;
    out.covariance = core::pseudo_inverse_of_symmetric(JtJ);
    out.parameters_used = (out.covariance * (J.topRows(n).transpose() * J.topRows(n))).trace();
    out.chi2 = r.head(n).squaredNorm();
    out.converged = found.converged;
    out.x = found.x;
    out.sigma_m = sigma;
    starts = {found.x}, other_starts.clear();
    if (round + 1 < rounds) sigma = std::max(sigma * std::sqrt(out.chi2 / out.degrees_of_freedom()), 1e-9);
  }
  out.prior_sigma.resize(parameters.size());
  for (int i = 0; i < parameters.size(); ++i) out.prior_sigma[i] = parameters.list()[i].spread;
  out.misfits = misfits(forward, parameters, out.x, options.experiments);
  return out;
}

double cost_ahead(const ForwardModel& forward, const Parameters& parameters, const FitOptions& options) {
  const FitProblem problem(forward, parameters, options.experiments,
                           {options.sigma_m.value_or(options.guess_m), options.noise}, true);
  double least = std::numeric_limits<double>::infinity();
  for (const VectorXd& start : options.starts) {
    const LeastSquares bounds = problem.least_squares(start);
    VectorXd r;
    MatrixXd J;
    if (!problem.evaluate(bounds.start, r, &J)) continue;
    const VectorXd to = (bounds.start - core::pseudo_inverse_of_symmetric(J.transpose() * J) * (J.transpose() * r))
                            .cwiseMax(bounds.least)
                            .cwiseMin(bounds.most);
    least = std::min(least, (r + J * (to - bounds.start)).squaredNorm() / 2);
  }
  return least;
}

std::vector<VectorXd> misfits(const ForwardModel& forward, const Parameters& parameters, const VectorXd& x,
                              const std::vector<int>& chosen) {
  const Changes changes = parameters.changes(x);
  const auto shapes = forward.shapes({changes}, chosen)[0];
  std::vector<VectorXd> out;
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const Experiment& e = forward.set().experiments[chosen[k]];
    out.push_back(shapes[k].converged ? misfit(e, shapes[k], seen(forward.set(), e, changes, parameters.view(x)))
                                      : VectorXd());
  }
  return out;
}

}  // namespace ostium::data
