#pragma once
/// How hard a stiff wire presses on the walls of a tube with a bend, by its stiffness alone.
///
/// Small deviations w from the tube's axis, |w| <= c, minimise the energy EI / 2 (w'' + 1/R)^2 in the bend and
/// EI / 2 w''^2 beside it. In a long bend the wire lies on its inner wall with the curvature 1/R. Where the bend ends
/// it leaves that wall with the moment EI / R, and falls with a straight line of moments to a point on the outer wall
/// of the straight part, over a length l, half of it in the bend: 2 c = l^2 / (6 R) - l^2 / (8 R), so l = sqrt(48 R c),
/// and it presses at either end of l with EI / (R l). At a tip inside the bend, without a moment there, it falls over
/// l = sqrt(12 R c). In units of EI / (R sqrt(R c)), all forces of an end of a bend add up to 2 / sqrt(48), those of a
/// tip to 2 / sqrt(12). Tips less than sqrt(48 R c) behind the beginning of a bend, or five sqrt(R c) behind its end,
/// and bends shorter than that, press less or more; the tables below are the same minimum for those, computed with
/// nodes 0.1 sqrt(R c) apart.
#include <algorithm>
#include <array>
#include <cmath>

namespace ostium::data::push_pull {

/// Sums of forces in units of EI / (R sqrt(R c)), at the bend's beginning and at its end or the tip.
struct ContactForces {
  double at_beginning = 0, at_end = 0;
};

namespace contact {

template <std::size_t count>
double between(const std::array<double, count>& x, const std::array<double, count>& y, double at) {
  if (at <= x.front()) return y.front();
  for (std::size_t i = 1; i < count; ++i)
    if (at < x[i]) return y[i - 1] + (at - x[i - 1]) / (x[i] - x[i - 1]) * (y[i] - y[i - 1]);
  return y.back();
}

/// With a tip so far in the bend, all together.
inline double tip_inside(double depth) {
  constexpr std::array<double, 10> x = {2, 2.25, 2.5, 3, 3.5, 4, 4.5, 5, 6, 7},
                                   y = {0, 0.012, 0.075, 0.236, 0.416, 0.569, 0.687, 0.765, 0.848, 0.866};
  return between(x, y, depth);
}

/// With a tip so far beyond a bend of such a length, all together.
inline double tip_beyond(double beyond, double length) {
  constexpr std::array<double, 9> x = {0, 0.5, 1, 1.5, 2, 2.5, 3, 4, 5};
  constexpr std::array<std::array<double, 9>, 7> rows = {
      {{0, 0, 0, 0, 0.004, 0.020, 0.028, 0.035, 0.037},
       {0, 0.058, 0.139, 0.188, 0.210, 0.215, 0.210, 0.190, 0.169},
       {0.236, 0.387, 0.454, 0.464, 0.446, 0.422, 0.393, 0.341, 0.307},
       {0.569, 0.653, 0.666, 0.639, 0.597, 0.553, 0.513, 0.444, 0.444},
       {0.765, 0.795, 0.769, 0.723, 0.670, 0.621, 0.577, 0.528, 0.528},
       {0.848, 0.843, 0.803, 0.749, 0.695, 0.646, 0.604, 0.568, 0.568},
       {0.866, 0.849, 0.805, 0.750, 0.697, 0.649, 0.609, 0.577, 0.577}}};
  const double at = std::clamp(length, 0.0, 7.0);
  const auto above = static_cast<std::size_t>(std::clamp(std::ceil(at), 1.0, 7.0));
  const double high = between(x, rows[above - 1], beyond), low = above > 1 ? between(x, rows[above - 2], beyond) : 0;
  return low + (at - static_cast<double>(above - 1)) * (high - low);
}

/// Of a place in a bend where the stiffness changes, in units of the larger EI.
inline double at_change(double smaller_over_larger) {
  constexpr std::array<double, 7> x = {0, 0.05, 0.1, 0.2, 0.3, 0.5, 0.7},
                                  y = {0.577, 0.431, 0.362, 0.253, 0.162, 0.01, 0};
  return between(x, y, smaller_over_larger);
}

}  // namespace contact

/// `depth`, `length`: of the tip behind the bend's beginning, and of the bend, over sqrt(R c).
inline ContactForces contact_forces(double depth, double length) {
  if (depth <= 0) return {};
  if (depth < length) {
    const double all = contact::tip_inside(depth);
    return {all / 3, all * 2 / 3};
  }
  const double all = contact::tip_beyond(depth - length, length), through = contact::tip_beyond(5, length);
  return {std::min(through / 2, all / 2), all - std::min(through / 2, all / 2)};
}

}  // namespace ostium::data::push_pull
