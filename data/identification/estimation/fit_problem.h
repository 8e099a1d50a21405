#pragma once
/// One fit as a least-squares problem. Residuals: the misfits over sigma, and the deviations from the priors over their
/// spreads.
#include "data/identification/estimation/forward_model.h"
#include "data/identification/estimation/parameters.h"
#include "data/identification/minimisation/secant_descent.h"
#include "data/identification/residuals/noise.h"

namespace ostium::data {

/// How the data are weighed: by one sigma or, along centrelines, by a noise model.
struct Weighing {
  double sigma_m = 0;
  std::optional<NoiseModel> noise = {};
};

class FitProblem {
 public:
  /// `rough`: one-sided finite differences.
  FitProblem(const ForwardModel& forward, const Parameters& parameters, const std::vector<int>& chosen,
             const Weighing& weighing, bool rough);

  int data_rows() const { return rows_; }
  bool in_vessel() const { return forward_.set().vessel.has_value(); }

  LeastSquares least_squares(const Eigen::VectorXd& start) const;
  /// For a set in a vessel, where one insertion history costs as much as hundreds of static shapes.
  SecantDescent by_secants(const LeastSquares& descent, bool rough) const;
  /// From here on, uses central differences as wide as the noise: from J, the Jacobian so far, it finds the step that
  /// changes the data by one standard deviation. Kinks finer than that do not affect what the data say, and spurious
  /// differences between two histories are not mistaken for a derivative.
  void widen_to_noise(const Eigen::MatrixXd& J);

  bool evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& residuals, Eigen::MatrixXd* jacobian) const;

 private:
  bool fill_jacobian(const Eigen::VectorXd& x, const Eigen::VectorXd& residuals,
                     const std::vector<std::vector<PredictedShape>>& found, Eigen::MatrixXd& J) const;
  /// x with its i-th number moved by one step, within its range.
  Eigen::VectorXd moved(Eigen::VectorXd x, int i, double sign) const;
  /// Mean of the two one-sided derivatives. For an experiment in which one of them is much larger, the other: there a
  /// wire snaps to another place, which says no more about the parameter than on which side of a threshold it is.
  Eigen::VectorXd without_snaps(const Eigen::VectorXd& up, const Eigen::VectorXd& down) const;
  bool data(const std::vector<PredictedShape>& shapes, const Eigen::VectorXd& x, Eigen::VectorXd& residuals) const;

  const ForwardModel& forward_;
  const Parameters& parameters_;
  const std::vector<int>& chosen_;
  double sigma_;
  std::vector<Decorrelator> decorrelators_;  ///< one per experiment; empty: independent normal noise
  std::optional<double> push_sigma_N_;
  bool rough_;             ///< one-sided differences
  Eigen::VectorXd steps_;  ///< step sizes; empty: those of the parameters
  int rows_ = 0;
  std::vector<int> block_ends_;  ///< last row + 1 of each experiment
};

}  // namespace ostium::data
