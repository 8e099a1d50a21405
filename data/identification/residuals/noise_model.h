#pragma once
/// Noise as it is, not as it was declared: its size, how far neighbours share it, and how heavy its tails are. Pure
/// functions of residuals; what a trace is (the misfits of a centreline, of a force curve) is the caller's affair.
///
/// Covariance of two points of a trace: sigma^2 ((1 - white) c + white [same point]), with c = exp(-d / length), or
/// exp(-(d / length)^2 / 2) where it is smooth (Rasmussen, Williams 2006, Gaussian Processes, 4.2). The decorrelated
/// residuals of a point (Cholesky) are normal, or Student's t of `degrees` (Lange, Little, Taylor 1989, J Am Stat Assoc
/// 84:881). Traces are independent of one another.
#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace ostium::data {

/// The residuals of one experiment, in order along it.
struct ResidualTrace {
  Eigen::VectorXd at;      ///< where each stands, increasing: m along a wire, or whatever a curve is measured over
  Eigen::MatrixXd values;  ///< #points by #components, of equal variance
  double numbers = 1;      ///< independent components of a point: 2 of 3 if residuals are perpendicular to a wire
};

struct NoiseModel {
  double sigma = 0;     ///< of a component; of heavy tails their scale, so that the far points do not count
  double length = 0;    ///< over which correlation falls, in the unit of `at`; 0: neighbours share nothing
  bool smooth = false;  ///< what neighbours share changes smoothly along a trace
  double white = 0;     ///< part of the variance that no neighbour shares, if length > 0
  double degrees = std::numeric_limits<double>::infinity();  ///< of Student's t; infinite: normal
  bool as_declared = false;

  bool correlated() const { return length > 0; }
  bool heavy() const { return degrees < std::numeric_limits<double>::infinity(); }
};

/// The simplest model that none with more numbers beats by `strong` in BIC, from the one that was declared (`declared`,
/// if any) to one that is correlated and heavy. Without a declared sigma: of whatever size fits. Needs about thirty
/// points; fewer leave the declared one, or normal and uncorrelated noise.
NoiseModel noise_model_of(const std::vector<ResidualTrace>& traces, std::optional<double> declared, double strong = 6);

/// What is to be said where what is left is far smaller than the noise that was declared; else empty.
std::string doubt_of_noise(double chi2_per_dof, double degrees_of_freedom);

/// Makes the residuals of one trace independent numbers of unit variance, if the model holds; rows as in the trace. Far
/// points of heavy tails are drawn in, so that the sum of squares is minus twice the log likelihood, up to what depends
/// on the model alone.
class Decorrelator {
 public:
  Decorrelator(const Eigen::VectorXd& at, double numbers, const NoiseModel& model);
  Eigen::MatrixXd operator()(const Eigen::MatrixXd& values) const;

 private:
  NoiseModel model_;
  double numbers_;
  Eigen::MatrixXd factor_;  ///< lower Cholesky factor of the correlations; empty: there are none
};
Eigen::MatrixXd decorrelated(const ResidualTrace& trace, const NoiseModel& model);

/// The sum of squares of a point's decorrelated numbers that the model expects, over their count: 1 if it is normal.
double expected_square(const NoiseModel& model, double numbers);

/// Minus twice the log likelihood of the residuals.
double minus_two_log_likelihood(const std::vector<ResidualTrace>& traces, const NoiseModel& model);

/// Minus twice the log likelihood under the noise that these residuals show (noise_model_of), and what its numbers
/// cost: compares models each of which has its own noise.
double own_noise_cost(const std::vector<ResidualTrace>& traces, std::optional<double> declared);

/// How many independent numbers would tell a mean as well as these.
double effective_numbers(const std::vector<ResidualTrace>& traces, const NoiseModel& model);

/// What is not as declared, in words: "0.31 mm, 2.1 times what is declared; ..."; `mm`: the unit of sigma and length in
/// SI and its name.
std::string in_words(const NoiseModel& model, std::optional<double> declared, double unit, const std::string& name);

}  // namespace ostium::data
