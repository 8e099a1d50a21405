#pragma once
/// One fit as a problem of least squares: the residuals are the misfits over sigma, and the distances from the priors
/// over their spreads.
#include "data/identification/estimation/forward_model.h"
#include "data/identification/estimation/parameters.h"
#include "data/identification/estimation/secant_descent.h"

namespace ostium::data {

class FitProblem {
 public:
  /// `rough`: finite differences to one side only.
  FitProblem(const ForwardModel& forward, const Parameters& parameters, const std::vector<int>& chosen, double sigma_m,
             bool rough);

  int data_rows() const { return rows_; }
  bool in_vessel() const { return forward_.set().vessel.has_value(); }

  LeastSquares least_squares(const Eigen::VectorXd& start) const;
  /// Of a set in a vessel, where one history takes as long as hundreds of shapes.
  SecantDescent by_secants(const LeastSquares& descent, bool rough) const;
  /// From here on differences go to both sides and are as wide as the noise: J, taken so far, says which step moves the
  /// data by one standard deviation. Kinks finer than that do not matter to what the data say, and a difference between
  /// two histories that has no cause is not taken for a derivative.
  void widen_to_noise(const Eigen::MatrixXd& J);

  bool evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& residuals, Eigen::MatrixXd* jacobian) const;

 private:
  bool fill_jacobian(const Eigen::VectorXd& x, const Eigen::VectorXd& residuals,
                     const std::vector<std::vector<PredictedShape>>& found, Eigen::MatrixXd& J) const;
  /// x with its i-th number a step to one side, but within its range.
  Eigen::VectorXd moved(Eigen::VectorXd x, int i, double sign) const;
  /// The mean of derivatives to both sides; of an experiment in which only one of them is large, the other: there a
  /// wire snaps to another place, which says no more of the number than on which side of it it is.
  Eigen::VectorXd without_snaps(const Eigen::VectorXd& up, const Eigen::VectorXd& down) const;
  bool data(const std::vector<PredictedShape>& shapes, const Eigen::VectorXd& x, Eigen::VectorXd& residuals) const;

  const ForwardModel& forward_;
  const Parameters& parameters_;
  const std::vector<int>& chosen_;
  double sigma_;
  std::optional<double> push_sigma_N_;
  bool rough_;             ///< differences to one side
  Eigen::VectorXd steps_;  ///< of differences; empty: as the parameters have them
  int rows_ = 0;
  std::vector<int> block_ends_;  ///< of the rows of each experiment
};

}  // namespace ostium::data
