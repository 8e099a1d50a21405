#pragma once
/// Damped Newton descent for chains described by their angles.
#include <Eigen/Dense>
#include <cmath>

namespace ostium::test {

struct ChainDescent {
  double tolerance_rad = 1e-9, longest_turn_rad = 0.1;
  int most_iterations = 200;
};

/// Takes `angle` to a minimum of energy(angle), whose gradient and Hessian linearise(gradient, hessian) gives at
/// `angle`. False if no minimum is found.
template <class Energy, class Linearise>
bool descend(const ChainDescent& d, const Energy& energy, const Linearise& linearise, Eigen::VectorXd& angle) {
  const Eigen::Index n = angle.size();
  Eigen::VectorXd gradient;
  Eigen::MatrixXd hessian;
  double now = energy(angle);
  for (int iteration = 0; iteration < d.most_iterations; ++iteration) {
    linearise(gradient, hessian);
    const double typical = hessian.diagonal().cwiseAbs().maxCoeff();
    Eigen::LLT<Eigen::MatrixXd> factors(hessian);
    for (double shift = 1e-10 * typical; factors.info() != Eigen::Success; shift *= 10)
      factors.compute(hessian + shift * Eigen::MatrixXd::Identity(n, n));
    Eigen::VectorXd step = -factors.solve(gradient);
    const double longest = step.cwiseAbs().maxCoeff();
    if (longest < d.tolerance_rad) return true;
    if (longest > d.longest_turn_rad) step *= d.longest_turn_rad / longest;
    double part = 1, tried = energy(angle + step);
    // Near the minimum, energies differ by less than their rounding errors.
    while (tried > now + 1e-14 * std::fabs(now) && part > 1e-8) part /= 2, tried = energy(angle + part * step);
    if (part <= 1e-8) return longest < 1e-6;
    angle += part * step, now = tried;
  }
  return false;
}

}  // namespace ostium::test
