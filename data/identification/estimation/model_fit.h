#pragma once
/// One model of a set, declared or with effects, fitted in full and fold by fold.
#include "data/identification/estimation/fit.h"
#include "data/identification/estimation/fitted_model.h"

namespace ostium::data {

class ModelFit {
 public:
  /// `spread`: priors of the effects' parameters are so many times as wide as they say.
  ModelFit(const MeasurementSet& set, const Workers& workers, const std::vector<ActiveEffect>& tried,
           const std::function<void(const std::string&)>& progress, double spread = 1);
  ModelFit(const ModelFit&) = delete;

  /// Everything but what needs the noise, which `judge` adds. `noise_m`: none if it is not declared. Throws LoadError
  /// naming the experiment that has no static shape.
  FittedModel run(std::optional<double> noise_m);
  /// A rough fit to all data alone, begun from another model's values of the parameters that both have. `guess_m`:
  /// about what is left, where the noise is not known.
  FittedModel run_near(const FittedModel& near, std::optional<double> noise_m, double guess_m, int starts);
  /// About what `run_near` could come to, at a tenth of its price (`cost_ahead`).
  double cost_ahead_near(const FittedModel& near, std::optional<double> noise_m, double guess_m);
  /// Fits what `run_near` has found to the end, and adds held-out errors and what the rest goes with.
  void complete(FittedModel& model, std::optional<double> noise_m);
  /// Of the model after its fit (Laplace): the logarithm of how likely it makes the data, up to a constant that models
  /// of the same set and noise share.
  double log_evidence() const;
  void judge(FittedModel& model, const Noise& noise) const;
  /// After `run`: before anything was fitted.
  std::vector<Eigen::VectorXd> misfits_at_start() const;

 private:
  std::size_t descents() const;  ///< from how many starts a fit goes downhill
  void say(const std::string& what) const;
  FitOptions options_near(const FittedModel& near, std::optional<double> noise_m, double guess_m, int starts);
  /// Once more from where the measured pushes point to, if there are any.
  void refit_by_push(FitOptions options);
  /// Finds the shapes to continue from: those that the walk through the experiments comes to at x.
  void anchor(const Eigen::VectorXd& x);
  /// Anchors anew at what was fitted, and names the experiments that this brings to another shape.
  std::vector<std::string> on_other_branches();
  FittedModel report() const;
  void add_residual_tests(FittedModel& model) const;
  /// Adds each experiment's misfits by the fit that has not seen it, where that can be said.
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
  Fit fit_;
};

}  // namespace ostium::data
