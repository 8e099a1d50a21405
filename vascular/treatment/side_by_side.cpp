#include "vascular/treatment/side_by_side.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/units.h"

namespace ostium::vascular {

namespace {

using units::pi;

/// Of two equal ones of radius 1.
struct Equal {
  double arc, length, tension;
};
Equal flattened(double beta) {
  const double s = std::sin(beta), c = std::cos(beta), q = pi - beta + s, rho = pi / q;
  const double area_1_rad = 4 * ((1 - c) * (pi - beta + s * c) / q - s * s),
               length_1_rad = (1 - c) * (2 * pi + 4 * c) / q - 4 * s;
  return {rho, 2 * pi * rho + 4 * rho * c, beta > 0 ? rho * area_1_rad / length_1_rad : 0};
}

/// The lumen's radius where they are free (H), and where they are squeezed to the end, with their derivatives by a.
struct Limits {
  double hull_m, hull_by_a, round_m, round_by_a;
};
Limits limits(double a, double b) {
  static const double k = std::log(2) / std::log(flattened(pi / 2).length / (2 * pi));
  const double t = std::asin((a - b) / (a + b)), most = std::max(a, b);
  const double round_m = most * std::pow(std::pow(a / most, k) + std::pow(b / most, k), 1 / k);
  return {.hull_m = (pi * (a + b) + 2 * t * (a - b) + 4 * std::sqrt(a * b)) / (2 * pi),
          .hull_by_a = (pi + 2 * t + 2 * std::cos(t)) / (2 * pi),
          .round_m = round_m,
          .round_by_a = std::pow(a / round_m, k - 1)};
}
/// How much of the way from there is left.
double left(const Equal& now) {
  static const double free_m = flattened(0).length, round_m = flattened(pi / 2).length;
  return (now.length - round_m) / (free_m - round_m);
}

constexpr int steps = 64;  // of beta, to pi / 2
struct Step {
  double tension, left;
};
using Table = std::array<Step, steps + 1>;
Table make_table() {
  Table table;
  for (int i = 0; i <= steps; ++i) {
    const Equal at = flattened(pi / 2 * i / steps);
    table[i] = {at.tension, left(at)};
  }
  return table;
}

}  // namespace

SideBySide side_by_side(double a, double b, double beta) {
  if (b <= 0) return {a, 1, 1, 0};
  const Equal equal = flattened(beta);
  const Limits end = limits(a, b);
  const double share = left(equal);
  return {.lumen_m = share * end.hull_m + (1 - share) * end.round_m,
          .by_a = share * end.hull_by_a + (1 - share) * end.round_by_a,
          .narrow = 1 / (1 + std::cos(beta) * std::min(a, b) / std::max(a, b)),
          .apart_m = (a + b) * equal.arc * std::cos(beta)};
}

double flattened_rad(double a, double b, double filled_Pa, const DrawnBy& wall) {
  static const Table table = make_table();
  const Limits end = limits(a, b);
  // Above 0 where the balloons push harder apart than the wall draws them together.
  const auto over = [&](int i) {
    const double R = table[i].left * end.hull_m + (1 - table[i].left) * end.round_m;
    return (a + b) / 2 * filled_Pa * table[i].tension -
           R * std::max(0.0, wall.p_Pa + wall.slope_Pa_m * (R - wall.lumen_m));
  };
  int below = 0, above = steps;
  double under = over(0), beyond = over(steps);
  if (under >= 0) return 0;
  if (beyond <= 0) return pi / 2;
  while (above - below > 1) {
    const int middle = (below + above) / 2;
    const double there = over(middle);
    (there < 0 ? below : above) = middle, (there < 0 ? under : beyond) = there;
  }
  return pi / 2 * (below + under / (under - beyond)) / steps;
}

double drawn_round(double balloon, double lumen) {
  if (balloon >= lumen) return 1;
  return balloon / (balloon + pi / 2 * (lumen - balloon));
}

}  // namespace ostium::vascular
