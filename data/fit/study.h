#pragma once
/// One model of a set, declared or with effects, fitted in full and fold by fold.
#include "data/fit/explanation.h"

namespace ostium {

class Study {
 public:
  Study(const MeasurementSet& set, const Workers& workers, const std::vector<ActiveEffect>& tried,
        const std::function<void(const std::string&)>& progress);
  Study(const Study&) = delete;

  /// Everything but what needs the noise, which `judge` adds. `noise_m`: none if it is not declared. Throws LoadError
  /// naming the experiment that has no static shape.
  FittedModel run(std::optional<double> noise_m);
  void judge(FittedModel& model, const Noise& noise) const;
  /// After `run`: before anything was fitted.
  std::vector<Eigen::VectorXd> misfits_at_start() const;

 private:
  void say(const std::string& what) const;
  /// Finds the shapes to continue from: those that the walk through the experiments comes to at x.
  void anchor(const Eigen::VectorXd& x);
  /// Anchors anew at what was fitted, and names the experiments that this brings to another shape.
  std::vector<std::string> on_other_branches();
  FittedModel report() const;
  /// Misfits of each experiment by the fit that has not seen it; empty if that cannot be said.
  std::vector<Eigen::VectorXd> held_out(FitOptions options) const;

  const MeasurementSet& set_;
  const Workers& workers_;
  std::vector<int> all_;
  Parameters parameters_;
  std::vector<ActiveEffect> tried_;
  std::string name_;
  std::function<void(const std::string&)> progress_;
  std::optional<Forward> forward_;
  bool viewed_ = false;
  Fit fit_;
};

}  // namespace ostium
