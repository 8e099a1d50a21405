#include "data/identification/estimation/fit_problem.h"

#include <algorithm>
#include <cmath>

#include "data/identification/estimation/measured_push.h"
#include "data/identification/forward/misfit.h"

namespace ostium::data {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double snapped = 2;  // ratio of one-sided derivatives that counts as a snap

/// Step of the finite differences, in the optimiser's numbers.
double step_of(const Parameter& p) {
  if (p.step > 0) return p.step;  // set by the model's resolution
  return p.logarithmic ? 1e-4 : 1e-4 * std::max(p.spread, 1e-3);
}

}  // namespace

FitProblem::FitProblem(const ForwardModel& forward, const Parameters& parameters, const std::vector<int>& chosen,
                       const Weighing& weighing, bool rough)
    : forward_(forward),
      parameters_(parameters),
      chosen_(chosen),
      sigma_(weighing.sigma_m),
      push_sigma_N_(push_sigma_N(forward.set())),
      rough_(rough) {
  for (int e : chosen) {
    const Experiment& experiment = forward.set().experiments[e];
    rows_ += static_cast<int>(misfit_rows(experiment));
    if (push_sigma_N_ && experiment.proximal_force_N) ++rows_;
    block_ends_.push_back(rows_);
    if (weighing.noise) decorrelators_.emplace_back(along(experiment), 2, *weighing.noise);
  }
}

LeastSquares FitProblem::least_squares(const VectorXd& start) const {
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

SecantDescent FitProblem::by_secants(const LeastSquares& descent, bool rough) const {
  SecantDescent out;
  out.problem = descent, out.dear = parameters_.shape_parameters();
  out.scale.resize(parameters_.size());
  for (int i = 0; i < parameters_.size(); ++i) out.scale[i] = parameters_.list()[i].spread;
  out.last_radius = rough ? 0.1 : 0.03, out.least_gain = rough ? 0.1 : 0.01;
  out.most_evaluations = (rough ? 25 : 40) + 6 * out.dear;
  return out;
}

void FitProblem::widen_to_noise(const MatrixXd& J) {
  rough_ = false;
  steps_.resize(parameters_.shape_parameters());
  for (int i = 0; i < steps_.size(); ++i) {
    const double spread = parameters_.list()[i].spread;
    const double moves = J.col(i).head(rows_).norm() / std::sqrt(rows_);
    steps_[i] = std::clamp(1 / std::max(moves, 1e-9), 0.03 * spread, 0.5 * spread);
  }
}

bool FitProblem::evaluate(const VectorXd& x, VectorXd& residuals, MatrixXd* jacobian) const {
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
  return !jacobian || fill_jacobian(x, residuals, found, *jacobian);
}

bool FitProblem::fill_jacobian(const VectorXd& x, const VectorXd& residuals,
                               const std::vector<std::vector<PredictedShape>>& found, MatrixXd& J) const {
  const int shapes = parameters_.shape_parameters();
  J.setZero(residuals.size(), x.size());
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
    J(rows_ + i, i) = 1 / parameters_.list()[i].spread;
    if (above[i] == below[i]) continue;
    if (rough_ || !in_vessel() || above[i] == x[i] || below[i] == x[i])
      J.col(i).head(rows_) = (up - down).head(rows_) / (above[i] - below[i]);
    else
      J.col(i).head(rows_) = without_snaps((up - residuals).head(rows_) / (above[i] - x[i]),
                                           (residuals - down).head(rows_) / (x[i] - below[i]));
  }
  return true;
}

VectorXd FitProblem::moved(VectorXd x, int i, double sign) const {
  const Parameter& p = parameters_.list()[i];
  const double least = p.logarithmic ? std::log(p.least) : p.least, most = p.logarithmic ? std::log(p.most) : p.most;
  const double at = x[i], step = i < steps_.size() ? steps_[i] : step_of(p);
  x[i] = std::clamp(at + sign * step, least, most);
  if (rough_ && x[i] == at) x[i] = std::clamp(at - sign * step, least, most);
  return x;
}

VectorXd FitProblem::without_snaps(const VectorXd& up, const VectorXd& down) const {
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

bool FitProblem::data(const std::vector<PredictedShape>& shapes, const VectorXd& x, VectorXd& residuals) const {
  const MeasuredView view = parameters_.view(x);
  const Changes changes = parameters_.changes(x);
  int row = 0;
  for (std::size_t k = 0; k < chosen_.size(); ++k) {
    if (!shapes[k].converged) return false;
    const Experiment& e = forward_.set().experiments[chosen_[k]];
    const VectorXd off = misfit(e, shapes[k], seen(forward_.set(), e, changes, view));
    if (decorrelators_.empty())
      residuals.segment(row, off.size()) = off / sigma_;
    else
      residuals.segment(row, off.size()) =
          decorrelators_[k](off.reshaped(3, off.size() / 3).transpose()).transpose().reshaped();
    row += static_cast<int>(off.size());
    const std::optional<double> push_off_N = push_misfit_N(e, shapes[k]);
    if (push_sigma_N_ && push_off_N) residuals[row++] = *push_off_N / *push_sigma_N_;
  }
  return residuals.head(row).allFinite();
}

}  // namespace ostium::data
