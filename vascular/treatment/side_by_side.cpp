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

constexpr int steps = 64;
using Table = std::array<double, steps + 1>;  // of the tension, at equal steps of beta
Table tensions() {
  Table table;
  for (int i = 0; i <= steps; ++i) table[i] = flattened(pi / 2 * i / steps).tension;
  return table;
}

}  // namespace

SideBySide side_by_side(double a, double b, double beta) {
  if (b <= 0) return {a, 1, 1, 0};
  static const double free_m = flattened(0).length / (2 * pi), round_m = flattened(pi / 2).length / (2 * pi),
                      k = std::log(2) / std::log(round_m);
  const Equal equal = flattened(beta);
  const double keeps = (equal.length / (2 * pi) - round_m) / (free_m - round_m);
  const double t = std::asin((a - b) / (a + b)), most = std::max(a, b);
  const double hull = (pi * (a + b) + 2 * t * (a - b) + 4 * std::sqrt(a * b)) / (2 * pi),
               hull_by_a = (pi + 2 * t + 2 * std::cos(t)) / (2 * pi);
  const double round = most * std::pow(std::pow(a / most, k) + std::pow(b / most, k), 1 / k),
               round_by_a = std::pow(a / round, k - 1);
  return {.lumen_m = keeps * hull + (1 - keeps) * round,
          .by_a = keeps * hull_by_a + (1 - keeps) * round_by_a,
          .narrow = 1 / (1 + std::cos(beta) * std::min(a, b) / most),
          .apart_m = (a + b) * equal.arc * std::cos(beta)};
}

double flattened_rad(double tension) {
  static const Table table = tensions();
  if (!(tension > 0)) return 0;
  const auto above = std::upper_bound(table.begin(), table.end(), tension);
  if (above == table.end()) return pi / 2;
  const double share = (tension - above[-1]) / (above[0] - above[-1]);
  return pi / 2 * (static_cast<double>(above - table.begin() - 1) + share) / steps;
}

double drawn_round(double balloon, double lumen) {
  if (balloon >= lumen) return 1;
  return balloon / (balloon + pi / 2 * (lumen - balloon));
}

}  // namespace ostium::vascular
