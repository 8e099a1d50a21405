#pragma once
/// A moment-curvature curve without memory, by its tangent: the stiffness against EI at knots of curvature, straight
/// between them, 1 where the rod is not bent beyond rest, and constant beyond the last knot. With k the curvature
/// beyond rest, the moment over EI is the integral of the tangent, and rises with k as the tangent is positive.
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

namespace ostium::core {

struct BendingCurve {
  static constexpr int most = 12;
  int knots = 0;                               ///< 0: linear
  std::array<double, most> curvature_per_m{};  ///< > 0, rising
  std::array<double, most> tangent{};          ///< against EI; 0.01 to 100

  bool linear() const { return knots == 0; }

  /// Moment over EI at a curvature >= 0, 1/m.
  double moment_per_m(double k) const {
    double at = 0, slope = 1, moment = 0;
    for (int j = 0; j < knots; ++j) {
      const double wide = curvature_per_m[j] - at, u = std::min(k - at, wide);
      moment += u * (slope + 0.5 * (tangent[j] - slope) / wide * u);
      if (k <= curvature_per_m[j]) return moment;
      at = curvature_per_m[j], slope = tangent[j];
    }
    return moment + (k - at) * slope;
  }

  /// The curvature >= 0 at which the moment over EI is `m` >= 0.
  double curvature_at(double m) const {
    double at = 0, slope = 1, moment = 0;
    for (int j = 0; j < knots; ++j) {
      const double wide = curvature_per_m[j] - at, more = 0.5 * wide * (slope + tangent[j]);
      if (m <= moment + more) {
        // slope u + (tangent - slope) / wide u^2 / 2 = m - moment, without cancellation.
        const double bend = (tangent[j] - slope) / wide, rest = m - moment;
        return at + 2 * rest / (slope + std::sqrt(std::max(slope * slope + 2 * bend * rest, 0.0)));
      }
      at = curvature_per_m[j], slope = tangent[j], moment += more;
    }
    return at + (m - moment) / slope;
  }
};

/// Where the slope of a rod's tangent curves changes: at no curvature, and at their knots.
inline constexpr int bending_knots = BendingCurve::most + 1;
struct BendingKnots {
  int count = 0;  ///< 0: no curve
  std::array<double, bending_knots> at_per_m{};
};

/// Integrals over a stretch of a rod of what its bending has besides EI.
struct BendingIntegrals {
  Eigen::Vector2d softening = Eigen::Vector2d::Zero();  ///< of (1 / softening_per_m or 0, 1 - softened_ratio)
  std::array<double, bending_knots> bends_m2{};         ///< of the changes of the tangent's slope at the knots
};

/// The knots of a curve, and the changes of slope there.
inline BendingKnots knots_of(const BendingCurve& curve) {
  BendingKnots out;
  for (int j = 0; j < curve.knots; ++j) out.at_per_m[j + 1] = curve.curvature_per_m[j];
  out.count = curve.knots > 0 ? curve.knots + 1 : 0;
  return out;
}

inline double slope_change_m(const BendingCurve& curve, int knot) {
  const auto slope = [&](int j) {  // before knot j
    if (j == 0 || j > curve.knots) return 0.0;
    const double from = j > 1 ? curve.curvature_per_m[j - 2] : 0, at = j > 1 ? curve.tangent[j - 2] : 1;
    return (curve.tangent[j - 1] - at) / (curve.curvature_per_m[j - 1] - from);
  };
  return slope(knot + 1) - slope(knot);
}

}  // namespace ostium::core
