#pragma once
/// Fits one model of a set, as declared or with effects, to all data and fold by fold.
#include "data/identification/estimation/fit.h"
#include "data/identification/estimation/fitted_model.h"

namespace ostium::data {

class ModelFit {
 public:
  /// `spread`: factor on the prior widths of the last effect's parameters.
  ModelFit(const MeasurementSet& set, const Workers& workers, const std::vector<ActiveEffect>& tried,
           const std::function<void(const std::string&)>& progress, double spread = 1);
  ModelFit(const ModelFit&) = delete;

  /// From here on, fits weigh the data by this noise model, if there is one.
  void weigh_by(const Noise& noise) { weighing_ = noise.model; }
  /// Fits and scores everything except what depends on the noise, which `judge` adds. `noise_m`: none if it is not
  /// declared. Throws LoadError naming the experiment that has no static shape.
  FittedModel run(std::optional<double> noise_m);
  /// A rough fit to all data only, started from another model's values of the shared parameters. `guess_m`: expected
  /// residual if the noise is unknown.
  FittedModel run_near(const FittedModel& near, std::optional<double> noise_m, double guess_m, int starts);
  /// Estimate of what `run_near` would reach, at a tenth of its cost (`cost_ahead`).
  double cost_ahead_near(const FittedModel& near, std::optional<double> noise_m, double guess_m);
  /// Completes the fit that `run_near` began, and adds held-out errors and the residual tests. If the workers throw
  /// Ended, the model is as it was, or complete but for the held-out errors.
  void complete(FittedModel& model, std::optional<double> noise_m);
  /// Log evidence of the fitted model (Laplace), up to a constant that is the same for all models of the same set and
  /// noise.
  double log_evidence() const;
  void judge(FittedModel& model, const Noise& noise) const;
  /// Call after `run`: the misfits before anything was fitted.
  std::vector<Eigen::VectorXd> misfits_at_start() const;

 private:
  std::size_t descents() const;  ///< number of starts to descend from
  void say(const std::string& what) const;
  void judge_by(const NoiseModel& noise, FittedModel& model) const;
  FitOptions options_near(const FittedModel& near, std::optional<double> noise_m, double guess_m, int starts);
  /// Refits, starting also from the stiffness that the measured pushes suggest, if there are any.
  void refit_by_push(FitOptions options);
  /// Computes the anchors: the shapes that walking through the experiments reaches at x.
  void anchor(const Eigen::VectorXd& x);
  /// Recomputes the anchors at the fitted values, and returns the experiments whose shape changes.
  std::vector<std::string> on_other_branches();
  FittedModel report() const;
  /// `wider`: factor on standard deviations.
  void add_laws(FittedModel& model, double wider) const;
  void add_residual_tests(FittedModel& model) const;
  /// Adds each experiment's misfits by the fit that left it out, where there is one.
  void score_held_out(FitOptions options, FittedModel& model) const;

  const MeasurementSet& set_;
  const Workers& workers_;
  std::vector<int> all_;
  Parameters parameters_;
  std::vector<ActiveEffect> tried_;
  std::string name_;
  std::function<void(const std::string&)> progress_;
  std::optional<ForwardModel> forward_;
  double longest_element_m_ = fine_elements_m;
  bool viewed_ = false;
  std::optional<NoiseModel> weighing_;
  Fit fit_;
};

}  // namespace ostium::data
