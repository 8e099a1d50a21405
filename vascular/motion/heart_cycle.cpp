#include "vascular/motion/heart_cycle.h"

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "vascular/geometry/implicit/spline.h"

namespace ostium::vascular {

namespace {

constexpr double two_pi = 2 * units::pi;
constexpr double mid_systole = end_systole / 2;
constexpr double even_rate_1_min = 70;

/// d time / d phase = (1 + stretch cos 2 pi (phase - mid_systole)) 60 / rate: lengthens systole as Bazett's root
/// requires.
double stretch(double rate_1_min) {
  const double rate = std::clamp(rate_1_min, least_rate_1_min, highest_rate_1_min);
  const double share_of_systole = end_systole * std::sqrt(rate / even_rate_1_min);
  return two_pi * (share_of_systole - end_systole) / (2 * std::sin(two_pi * mid_systole));
}

constexpr int samples = 40;

/// Every 1/40 of a cycle. Ejection is fastest in the first fifth; end-systole (including isovolumic relaxation) lasts
/// to 0.46, early filling to 0.66, then diastasis; the atria contract from 0.84.
const double table[samples] = {
    0.000, 0.040, 0.130, 0.235, 0.345, 0.455, 0.560, 0.655, 0.740, 0.810,  // 0 to 0.225
    0.868, 0.912, 0.945, 0.970, 0.990, 1.000, 0.999, 0.992, 0.976, 0.950,  // 0.25 to 0.475
    0.908, 0.848, 0.775, 0.692, 0.608, 0.528, 0.458, 0.400, 0.355, 0.325,  // 0.5 to 0.725
    0.305, 0.292, 0.280, 0.260, 0.225, 0.178, 0.125, 0.075, 0.035, 0.010   // 0.75 to 0.975
};

}  // namespace

double phase_speed(double phase, double rate_1_min) {
  const double rate = std::clamp(rate_1_min, least_rate_1_min, highest_rate_1_min);
  return rate / 60 / (1 + stretch(rate) * std::cos(two_pi * (phase - mid_systole)));
}

double time_at(double phase, double rate_1_min) {
  const double rate = std::clamp(rate_1_min, least_rate_1_min, highest_rate_1_min);
  const double surplus = std::sin(two_pi * (phase - mid_systole)) + std::sin(two_pi * mid_systole);
  return 60 / rate * (phase + stretch(rate) / two_pi * surplus);
}

double contraction(double phase) {
  static const Eigen::VectorXd coefficients = periodic_b_spline(Eigen::Map<const Eigen::VectorXd>(table, samples));
  const double u = (phase - std::floor(phase)) * samples;
  const int i = static_cast<int>(u);
  const Eigen::Vector4d w = b_spline_weights(u - i);
  double sum = 0;
  for (int k = 0; k < 4; ++k) sum += w[k] * coefficients[(i + k + samples - 1) % samples];
  return sum;
}

double breath_depth(double phase) { return std::pow(std::sin(units::pi * phase), 4); }

}  // namespace ostium::vascular
