#include "data/identification/estimation/fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "data/identification/estimation/least_squares.h"
#include "data/identification/estimation/measured_push.h"
#include "data/identification/estimation/secant_descent.h"

namespace ostium {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double rough_tolerance = 1e-5;
constexpr int rough_iterations = 25;
constexpr std::size_t tasted = 3;  // of each sort of starts
constexpr int taste_iterations = 4;
constexpr double snapped = 2;  // times the derivative to the other side

/// Of the finite differences, in the optimiser's numbers.
double step_of(const Parameter& p) {
  if (p.step > 0) return p.step;  // set by what the model can resolve
  return p.logarithmic ? 1e-4 : 1e-4 * std::max(p.spread, 1e-3);
}

/// One fit: its residuals are the misfits over sigma, and the distances from the priors over their spreads.
class Problem {
 public:
  Problem(const Forward& forward, const Parameters& parameters, const std::vector<int>& chosen, double sigma_m,
          bool rough)
      : forward_(forward),
        parameters_(parameters),
        chosen_(chosen),
        sigma_(sigma_m),
        push_sigma_N_(push_sigma_N(forward.set())),
        rough_(rough) {
    for (int e : chosen) {
      const Experiment& experiment = forward.set().experiments[e];
      rows_ += experiment.kind == Experiment::Kind::radius ? 1 : 3 * static_cast<int>(experiment.points_m.size());
      if (push_sigma_N_ && experiment.proximal_force_N) ++rows_;
      block_ends_.push_back(rows_);
    }
  }

  int data_rows() const { return rows_; }
  bool in_vessel() const { return forward_.set().vessel.has_value(); }

  LeastSquares least_squares(const VectorXd& start) const {
    LeastSquares problem;
    const auto& list = parameters_.list();
    problem.residuals = rows_ + parameters_.size();
    problem.start = start;
    problem.least.resize(parameters_.size()), problem.most.resize(parameters_.size());
    for (int i = 0; i < parameters_.size(); ++i) {
      problem.least[i] = list[i].logarithmic ? std::log(list[i].least) : list[i].least;
      problem.most[i] = list[i].logarithmic ? std::log(list[i].most) : list[i].most;
    }
    problem.start = start.cwiseMax(problem.least).cwiseMin(problem.most);
    problem.evaluate = [this](const VectorXd& x, VectorXd& r, MatrixXd* J) { return evaluate(x, r, J); };
    return problem;
  }

  /// Of a set in a vessel, where a history takes as long as hundreds of shapes.
  SecantDescent by_secants(const LeastSquares& descent, bool rough) const {
    SecantDescent out;
    out.problem = descent, out.dear = parameters_.shape_parameters();
    out.scale.resize(parameters_.size());
    for (int i = 0; i < parameters_.size(); ++i) out.scale[i] = parameters_.list()[i].spread;
    out.last_radius = rough ? 0.1 : 0.03, out.least_gain = rough ? 0.1 : 0.01;
    out.most_evaluations = (rough ? 25 : 40) + 6 * out.dear;
    return out;
  }
  /// From here on differences are to both sides, and as wide as the noise: what J, taken so far, says moves each number
  /// by one standard deviation. Kinks that are finer do not matter to what the data say, and what two histories differ
  /// by for no reason is not taken for a derivative.
  void widen_to_noise(const MatrixXd& J) {
    rough_ = false;
    steps_.resize(parameters_.shape_parameters());
    for (int i = 0; i < steps_.size(); ++i) {
      const double spread = parameters_.list()[i].spread;
      const double moves = J.col(i).head(rows_).norm() / std::sqrt(rows_);
      steps_[i] = std::clamp(1 / std::max(moves, 1e-9), 0.03 * spread, 0.5 * spread);
    }
  }

  bool evaluate(const VectorXd& x, VectorXd& residuals, MatrixXd* jacobian) const {
    const int shapes = jacobian ? parameters_.shape_parameters() : 0;
    std::vector<Changes> changes = {parameters_.changes(x)};
    for (int i = 0; i < shapes; ++i)
      for (double sign : {1.0, -1.0})
        if (sign > 0 || !rough_) changes.push_back(parameters_.changes(moved(x, i, sign)));
    const auto found = forward_.shapes(changes, chosen_);
    residuals.resize(rows_ + x.size());
    if (!data(found[0], x, residuals)) return false;
    const VectorXd prior = parameters_.start();
    for (int i = 0; i < x.size(); ++i) residuals[rows_ + i] = (x[i] - prior[i]) / parameters_.list()[i].spread;
    if (!jacobian) return true;

    jacobian->setZero(residuals.size(), x.size());
    VectorXd up(residuals.size()), down(residuals.size());
    for (int i = 0; i < x.size(); ++i) {
      const bool moves = i < shapes;
      const int at = rough_ ? 1 + i : 1 + 2 * i;
      const VectorXd above = moved(x, i, 1), below = rough_ ? x : moved(x, i, -1);
      if (!data(moves ? found[at] : found[0], above, up)) return false;
      if (rough_)
        down = residuals;
      else if (!data(moves ? found[at + 1] : found[0], below, down))
        return false;
      (*jacobian)(rows_ + i, i) = 1 / parameters_.list()[i].spread;
      if (above[i] == below[i]) continue;
      if (rough_ || !in_vessel() || above[i] == x[i] || below[i] == x[i])
        jacobian->col(i).head(rows_) = (up - down).head(rows_) / (above[i] - below[i]);
      else
        jacobian->col(i).head(rows_) = without_snaps((up - residuals).head(rows_) / (above[i] - x[i]),
                                                     (residuals - down).head(rows_) / (x[i] - below[i]));
    }
    return true;
  }

 private:
  /// x with its i-th number a step to one side, but within its range.
  VectorXd moved(VectorXd x, int i, double sign) const {
    const Parameter& p = parameters_.list()[i];
    const double least = p.logarithmic ? std::log(p.least) : p.least, most = p.logarithmic ? std::log(p.most) : p.most;
    const double at = x[i], step = i < steps_.size() ? steps_[i] : step_of(p);
    x[i] = std::clamp(at + sign * step, least, most);
    if (rough_ && x[i] == at) x[i] = std::clamp(at - sign * step, least, most);
    return x;
  }

  /// The mean of derivatives to both sides; of an experiment in which only one of them is large, the other: there a
  /// wire snaps to another place, which says no more of the number than on which side of it it is.
  VectorXd without_snaps(const VectorXd& up, const VectorXd& down) const {
    VectorXd out(rows_);
    int from = 0;
    for (const int to : block_ends_) {
      const auto a = up.segment(from, to - from), b = down.segment(from, to - from);
      const double more = a.norm(), less = b.norm();
      out.segment(from, to - from) = more > snapped * less   ? VectorXd(b)
                                     : less > snapped * more ? VectorXd(a)
                                                             : VectorXd((a + b) / 2);
      from = to;
    }
    return out;
  }

  bool data(const std::vector<Shape>& shapes, const VectorXd& x, VectorXd& residuals) const {
    const MeasuredView view = parameters_.view(x);
    const Changes changes = parameters_.changes(x);
    int row = 0;
    for (std::size_t k = 0; k < chosen_.size(); ++k) {
      if (!shapes[k].converged) return false;
      const Experiment& e = forward_.set().experiments[chosen_[k]];
      const VectorXd off = misfit(e, shapes[k], seen(forward_.set(), e, changes, view));
      residuals.segment(row, off.size()) = off / sigma_;
      row += static_cast<int>(off.size());
      const std::optional<double> push_off_N = push_misfit_N(e, shapes[k]);
      if (push_sigma_N_ && push_off_N) residuals[row++] = *push_off_N / *push_sigma_N_;
    }
    return residuals.head(row).allFinite();
  }

  const Forward& forward_;
  const Parameters& parameters_;
  const std::vector<int>& chosen_;
  double sigma_;
  std::optional<double> push_sigma_N_;
  bool rough_;      ///< differences to one side
  VectorXd steps_;  ///< of differences; empty: as the parameters have them
  int rows_ = 0;
  std::vector<int> block_ends_;  ///< of the rows of each experiment
};

/// A point and what it costs there.
using Start = std::pair<double, VectorXd>;

/// The starts by what they cost, those that have no shapes left out.
std::vector<Start> screened(const Problem& problem, const std::vector<VectorXd>& starts) {
  std::vector<Start> out;
  for (const VectorXd& start : starts) {
    const VectorXd x = problem.least_squares(start).start;
    VectorXd r;
    if (problem.evaluate(x, r, nullptr)) out.emplace_back(r.squaredNorm() / 2, x);
  }
  std::stable_sort(out.begin(), out.end(), [](const Start& a, const Start& b) { return a.first < b.first; });
  return out;
}

LeastSquaresResult descend(const Problem& problem, const VectorXd& start, bool rough, int most_iterations) {
  LeastSquares descent = problem.least_squares(start);
  if (rough) descent.tolerance = rough_tolerance, descent.most_iterations = most_iterations;
  if (problem.in_vessel()) return minimise(problem.by_secants(descent, rough));
  return minimise(descent);
}

/// Screens the starts by what they cost, and goes downhill from the best.
LeastSquaresResult best_of(const Problem& problem, const FitOptions& options, const std::vector<VectorXd>& starts,
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

Fit fit(const Forward& forward, const Parameters& parameters, const FitOptions& options) {
  Fit out;
  const bool pushes = push_sigma_N(forward.set()).has_value();
  for (int e : options.experiments) {
    const Experiment& experiment = forward.set().experiments[e];
    out.measured += static_cast<double>(numbers_measured(experiment)) + (pushes && experiment.proximal_force_N ? 1 : 0);
  }
  std::vector<VectorXd> starts = options.starts, other_starts = options.other_starts;
  // Without a known noise, that of the residuals; the weight of the priors follows it, so a few times over.
  double sigma = options.sigma_m.value_or(options.guess_m);
  const int rounds = options.sigma_m ? 1 : options.rounds;
  for (int round = 0; round < rounds; ++round) {
    Problem problem(forward, parameters, options.experiments, sigma, options.rough || forward.set().vessel);
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
    out.covariance = JtJ.completeOrthogonalDecomposition().pseudoInverse();
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

double cost_ahead(const Forward& forward, const Parameters& parameters, const FitOptions& options) {
  const Problem problem(forward, parameters, options.experiments, options.sigma_m.value_or(options.guess_m), true);
  double least = std::numeric_limits<double>::infinity();
  for (const VectorXd& start : options.starts) {
    const LeastSquares bounds = problem.least_squares(start);
    VectorXd r;
    MatrixXd J;
    if (!problem.evaluate(bounds.start, r, &J)) continue;
    const VectorXd to = (bounds.start - (J.transpose() * J).completeOrthogonalDecomposition().solve(J.transpose() * r))
                            .cwiseMax(bounds.least)
                            .cwiseMin(bounds.most);
    least = std::min(least, (r + J * (to - bounds.start)).squaredNorm() / 2);
  }
  return least;
}

std::vector<VectorXd> misfits(const Forward& forward, const Parameters& parameters, const VectorXd& x,
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

}  // namespace ostium
