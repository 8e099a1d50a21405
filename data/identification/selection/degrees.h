#pragma once
/// How much of a residual a model removes: a verdict in degrees. Pure functions of numbers.
#include <optional>

namespace ostium::data {

/// A named effect removes most of what the declared model leaves beyond noise if no more than a tenth is left; a part
/// is worth a word if it is a tenth.
inline constexpr double most_of_it = 0.9, part_of_it = 0.1;

/// Chi-square of a model, and the degrees of freedom it has left.
struct Misfit {
  double chi2 = 0, degrees_of_freedom = 0;

  double beyond_noise() const { return chi2 - degrees_of_freedom; }
};

/// The share of what `before` leaves beyond noise that `after` removes, 0 to 1; none if `before` leaves noise only.
std::optional<double> share_removed(const Misfit& before, const Misfit& after);

/// Root mean square residual over that of noise.
double rms_over_noise(const Misfit& misfit);

/// Whether a second model removes most of what a first leaves beyond noise: then what it names besides is worth naming.
bool removes_most(const Misfit& before, const Misfit& after);

}  // namespace ostium::data
