#include "data/identification/estimation/model_fit.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "core/math/dense.h"
#include "data/identification/effects/effect_list.h"
#include "data/identification/estimation/fit_starts.h"
#include "data/identification/estimation/measured_push.h"
#include "data/identification/forward/misfit.h"

namespace ostium::data {

namespace {

using Eigen::VectorXd;

constexpr int further_starts = 7;
constexpr std::size_t most_descents = 2;
constexpr int starts_for_each = 12;  // at most, per added parameter
constexpr int starts_ahead = 6;
constexpr int starts_in_vessel = 8;          // a history costs as much as hundreds of shapes
constexpr double most_stiffer = 3;           // largest factor on all stiffness in one refit by push
constexpr double another_branch_m = 0.1e-3;  // tips farther apart than this are on different branches

std::vector<int> everyone(const MeasurementSet& set) {
  std::vector<int> all(set.experiments.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

}  // namespace

ModelFit::ModelFit(const MeasurementSet& set, const Workers& workers, const std::vector<ActiveEffect>& tried,
                   const std::function<void(const std::string&)>& progress, double spread)
    : set_(set),
      workers_(workers),
      all_(everyone(set)),
      parameters_(set, declared_effects(set), tried),
      tried_(tried),
      progress_(progress) {
  for (const ActiveEffect& effect : tried_) name_ += (name_.empty() ? "" : " + ") + effect.name();
  parameters_.widen_last_effect(spread);
  if (set_.vessel) parameters_.coarsen_steps();
  if (name_.empty()) name_ = "what is declared";
}

std::size_t ModelFit::descents() const { return set_.vessel ? 1 : most_descents; }

void ModelFit::say(const std::string& what) const {
  if (progress_) progress_(name_ + ": " + what);
}

FittedModel ModelFit::run(std::optional<double> noise_m) {
  longest_element_m_ = fine_elements_m;
  say("walking through the experiments");
  anchor(parameters_.start());
  say("fit");
  const int further = set_.vessel ? starts_in_vessel : further_starts;
  FitOptions options{all_, noise_m, starts_of(parameters_, parameters_.start(), 0, further), descents()};
  options.noise = weighing_;
  options.guess_m = set_.unit().size;
  fit_ = fit(*forward_, parameters_, options);
  const std::vector<std::string> others = on_other_branches();
  if (!others.empty()) {
    say("fit once more: the walk leads to another branch");
    options.starts = {fit_.x};
    fit_ = fit(*forward_, parameters_, options);
  }
  refit_by_push(options);
  FittedModel model = report();
  add_residual_tests(model);
  model.other_branches = others;
  score_held_out(options, model);
  return model;
}

FitOptions ModelFit::options_near(const FittedModel& near, std::optional<double> noise_m, double guess_m, int starts) {
  longest_element_m_ = coarse_elements_m;
  if (set_.vessel) starts = std::min(starts, starts_in_vessel);
  VectorXd x = parameters_.start();
  for (int i = 0; i < parameters_.size(); ++i)
    for (const FittedParameter& p : near.parameters)
      if (p.parameter.name == parameters_.list()[i].name) x[i] = parameters_.inner(i, p.value);
  anchor(x);
  // Parameters that the other model lacks are spread over their priors.
  int first = 0;
  const auto known = [&](int i) {
    return std::any_of(near.parameters.begin(), near.parameters.end(),
                       [&](const FittedParameter& p) { return p.parameter.name == parameters_.list()[i].name; });
  };
  while (first < parameters_.shape_parameters() && known(first)) ++first;
  const int spread = std::min(starts, starts_for_each * (parameters_.shape_parameters() - first));
  FitOptions options{all_, noise_m, starts_of(parameters_, x, first, spread), descents()};
  options.noise = weighing_;
  // Because it lacks these, the other model's stiffness may be far off; also start from the priors.
  if (starts > 0) {
    const auto others = starts_of(parameters_, parameters_.start(), first, spread / 2);
    if (set_.vessel)  // no time to follow both groups
      options.starts.insert(options.starts.end(), others.begin(), others.end());
    else
      options.other_starts = others;
  }
  options.guess_m = guess_m, options.rounds = 2, options.rough = true;
  return options;
}

double ModelFit::cost_ahead_near(const FittedModel& near, std::optional<double> noise_m, double guess_m) {
  FitOptions options = options_near(near, noise_m, guess_m, set_.vessel ? 0 : starts_ahead);
  options.starts.insert(options.starts.end(), options.other_starts.begin(), options.other_starts.end());
  return cost_ahead(*forward_, parameters_, options);
}

FittedModel ModelFit::run_near(const FittedModel& near, std::optional<double> noise_m, double guess_m, int starts) {
  say("fit");
  FitOptions options = options_near(near, noise_m, guess_m, starts);
  fit_ = fit(*forward_, parameters_, options);
  const std::vector<std::string> others = on_other_branches();
  if (!others.empty()) {
    options.starts = {fit_.x}, options.other_starts.clear();
    fit_ = fit(*forward_, parameters_, options);
  }
  refit_by_push(options);
  FittedModel model = report();
  model.other_branches = others;
  return model;
}

/// Shapes alone hardly distinguish a stiff instrument in a stiff wall from a soft one in a soft wall: descents along
/// that valley are slow and stop early. The ratio of measured to computed push gives the common stiffness factor.
void ModelFit::refit_by_push(FitOptions options) {
  if (!push_sigma_N(set_)) return;
  const std::vector<PredictedShape> shapes = forward_->shapes({parameters_.changes(fit_.x)}, all_)[0];
  double product = 0, square = 0;
  for (std::size_t e = 0; e < shapes.size(); ++e)
    if (const auto& measured = set_.experiments[e].proximal_force_N)
      product += *measured * shapes[e].base_push_N, square += shapes[e].base_push_N * shapes[e].base_push_N;
  const double stiffer = std::log(std::clamp(product / std::max(square, 1e-12), 1 / most_stiffer, most_stiffer));
  VectorXd x = fit_.x;
  for (int i = 0; i < parameters_.size(); ++i) {
    const std::string& name = parameters_.list()[i].name;
    if (name.starts_with("EI_scale") || name == "wall_compliance.stiffness_N_per_mm2") x[i] += stiffer;
  }
  options.starts = {fit_.x, x}, options.other_starts.clear(), options.descents = 2;
  fit_ = fit(*forward_, parameters_, options);
}

void ModelFit::complete(FittedModel& model, std::optional<double> noise_m) {
  longest_element_m_ = fine_elements_m;
  forward_->set_longest_element(longest_element_m_);
  FitOptions options{all_, noise_m, {fit_.x}, 1};
  options.guess_m = fit_.sigma_m, options.rounds = 2, options.noise = weighing_;
  const Fit before = fit_;
  fit_ = fit(*forward_, parameters_, options);
  FittedModel finished;
  try {
    finished = report();
  } catch (const Ended&) {
    fit_ = before;
    throw;
  }
  finished.other_branches = model.other_branches;
  model = std::move(finished);
  add_residual_tests(model);
  score_held_out(options, model);
}

double ModelFit::log_evidence() const {
  const VectorXd off = (fit_.x - parameters_.start()).cwiseQuotient(fit_.prior_sigma);
  const double log_det = core::log_determinant_of_symmetric(fit_.covariance) - 2 * fit_.prior_sigma.array().log().sum();
  return -0.5 * (fit_.chi2 + off.squaredNorm()) + 0.5 * log_det;
}

std::vector<VectorXd> ModelFit::misfits_at_start() const {
  return misfits(*forward_, parameters_, parameters_.start(), all_);
}

/// Independent numbers and their likelihood, as the noise model has them.
void ModelFit::judge_by(const NoiseModel& noise, FittedModel& model) const {
  const std::vector<ResidualTrace> traces = traces_of(set_, model.misfits);
  double chi2 = 0;
  std::vector<VectorXd> independent;
  for (const ResidualTrace& t : traces) {
    independent.emplace_back(decorrelated(t, noise).transpose().reshaped());
    chi2 += independent.back().squaredNorm() / expected_square(noise, t.numbers);
  }
  model.chi2_per_dof = chi2 / model.degrees_of_freedom;
  model.bic =
      minus_two_log_likelihood(traces, noise) + fit_.parameters_used * std::log(effective_numbers(traces, noise));
  model.correlation = correlation_along(set_, independent);
}

void ModelFit::judge(FittedModel& model, const Noise& noise) const {
  const double squares_m2 = fit_.chi2 * fit_.sigma_m * fit_.sigma_m, n = fit_.measured;
  model.degrees_of_freedom = fit_.degrees_of_freedom();
  model.parameters_used = fit_.parameters_used;
  if (noise.model) return judge_by(*noise.model, model);
  if (!noise.sigma_m) {
    model.bic = n * std::log(std::max(squares_m2, 1e-30) / n) + fit_.parameters_used * std::log(n);
    return;
  }
  const double chi2 = squares_m2 / (*noise.sigma_m * *noise.sigma_m);
  model.chi2_per_dof = chi2 / model.degrees_of_freedom;
  model.bic = chi2 + fit_.parameters_used * std::log(n);
  // A residual above the declared noise widens the parameters' uncertainty; if the noise was estimated, the fit has
  // included it.
  const double wider = noise.declared ? std::max(1.0, std::sqrt(*model.chi2_per_dof)) : 1;
  for (int i = 0; i < parameters_.size(); ++i)
    model.parameters[i].sigma = wider * parameters_.sigma(i, fit_.x[i], std::sqrt(fit_.covariance(i, i)));
  add_laws(model, wider);
}

void ModelFit::add_laws(FittedModel& model, double wider) const {
  model.laws.clear();
  for (std::size_t k = 0; k < tried_.size(); ++k) {
    if (!tried_[k].effect->law) continue;
    const auto law = [&](const VectorXd& x) {
      const Changes changes = parameters_.changes(x);
      return tried_[k].effect->law(changes.effects[set_.effects.size() + k], set_, changes);
    };
    model.laws.push_back(with_band(law, fit_.x, wider * wider * fit_.covariance, fit_.prior_sigma));
  }
}

void ModelFit::anchor(const VectorXd& x) {
  if (set_.vessel) {  // a history begins outside the vessel and needs no anchor
    if (!forward_) forward_.emplace(set_, workers_, std::vector<StaticEquilibrium>{});
    if (!viewed_ && set_.imaging.registration_free)
      parameters_.set_nominal_view(registered(set_, forward_->shapes({parameters_.changes(x)}, all_)[0]));
    viewed_ = true;
    return;
  }
  const Changes changes = parameters_.changes(x);
  std::vector<StaticEquilibrium> anchors = walk(set_, changes, {}, longest_element_m_);
  for (std::size_t e = 0; e < anchors.size(); ++e)
    if (const Experiment& asked = set_.experiments[e]; !anchors[e].converged)
      throw LoadError(no_static_shape(set_, asked, setup_of(set_, asked, changes, longest_element_m_)));
  forward_.emplace(set_, workers_, std::move(anchors));
  forward_->set_longest_element(longest_element_m_);
  if (viewed_) return;
  viewed_ = true;
  parameters_.set_nominal_view(registered(set_, forward_->shapes({parameters_.changes(x)}, all_)[0]));
}

std::vector<std::string> ModelFit::on_other_branches() {
  if (set_.vessel) return {};
  const auto fitted = forward_->shapes({parameters_.changes(fit_.x)}, all_)[0];
  anchor(fit_.x);
  const auto walked = forward_->shapes({parameters_.changes(fit_.x)}, all_)[0];
  std::vector<std::string> others;
  for (std::size_t e = 0; e < all_.size(); ++e)
    if ((fitted[e].points_m.back() - walked[e].points_m.back()).norm() > another_branch_m)
      others.push_back(set_.experiments[e].id);
  return others;
}

FittedModel ModelFit::report() const {
  FittedModel model;
  model.name = name_;
  for (const ActiveEffect& effect : tried_)
    if (std::find(model.effects.begin(), model.effects.end(), effect.effect->id) == model.effects.end())
      model.effects.push_back(effect.effect->id);
  for (int i = 0; i < parameters_.size(); ++i)
    model.parameters.push_back({parameters_.list()[i], parameters_.value(i, fit_.x[i]),
                                parameters_.sigma(i, fit_.x[i], std::sqrt(fit_.covariance(i, i))), fit_.informed(i)});
  add_laws(model, 1);
  model.changes = parameters_.changes(fit_.x);
  model.view = parameters_.view(fit_.x);
  model.rms_m = rms(set_, fit_.misfits);
  model.converged = fit_.converged;
  model.shapes = forward_->shapes({model.changes}, all_)[0];
  model.misfits = fit_.misfits;
  if (push_sigma_N(set_)) model.push_rms_N = push_rms_N(set_, model.shapes);
  for (int e : all_) model.experiment_rms_m.push_back(rms({&set_.experiments[e]}, {fit_.misfits[e]}));
  model.correlation = correlation_along(set_, fit_.misfits);
  return model;
}

void ModelFit::add_residual_tests(FittedModel& model) const {
  model.residual_tests = residual_tests(set_, fit_.misfits, model.view);
}

}  // namespace ostium::data
