#pragma once
/// The moment-curvature curve as a field: ln(tangent / EI) at knots of curvature, a random walk from 0 where the
/// instrument is not bent, so that independent normal steps hold it to a straight line and to no other form.
#include <algorithm>
#include <cmath>
#include <span>

#include "core/material/bending_curve.h"
#include "data/identification/effects/law_curve.h"

namespace ostium::data::bending_law {

inline constexpr int knots = core::BendingCurve::most;  ///< from `first` of the reach to the reach, evenly in logarithm
inline constexpr double first = 1.0 / 16;
inline constexpr double step_spread = 0.5;  ///< of ln(tangent) from a knot to the next
inline constexpr double most_step = 4;

inline double knot_per_m(int j, double reach_per_m) {
  return reach_per_m * std::pow(first, (knots - 1.0 - j) / (knots - 1));
}

/// `steps`: of ln(tangent), `knots` of them.
inline core::BendingCurve curve_of(std::span<const double> steps, double reach_per_m) {
  core::BendingCurve out;
  out.knots = knots;
  double log_tangent = 0;
  for (int j = 0; j < knots; ++j) {
    log_tangent += steps[static_cast<std::size_t>(j)];
    out.curvature_per_m[j] = knot_per_m(j, reach_per_m);
    out.tangent[j] = std::exp(std::clamp(log_tangent, std::log(0.02), std::log(20.0)));
  }
  return out;
}

/// Standard deviation of ln(moment) that the random walk has between its knots, where a straight line is drawn: a
/// Brownian bridge's integral has the variance step^2 / 12 of an interval, of which each is narrower than the next by
/// the ratio q of the knots.
inline double too_fine() {
  const double q = std::pow(1 / first, 1.0 / (knots - 1));
  return step_spread / std::sqrt(12.0) * (1 - 1 / q) / std::sqrt(1 - 1 / (q * q));
}

/// Moment over curvature, against the declared EI; `scale`: EI where it is not bent, against that declared.
/// `moment_per_m(k)`: moment over EI at a curvature; `fine(k)`: LawCurve::too_fine there.
template <class Moment, class Fine>
LawCurve table(const std::string& id, double scale, double reach_per_m, Moment&& moment_per_m, Fine&& fine) {
  constexpr int points = 41;
  constexpr double per_mm = 1e3;
  LawCurve out{id, "curvature", "1/mm", "moment over curvature, against the declared EI", "1", {}, 1};
  for (int i = 0; i < points; ++i) {
    const double k = reach_per_m * std::pow(20.0, static_cast<double>(i) / (points - 1) - 1);
    out.points.emplace_back(k / per_mm, scale * moment_per_m(k) / k);
    out.too_fine.push_back(fine(k));
  }
  return out;
}

}  // namespace ostium::data::bending_law
