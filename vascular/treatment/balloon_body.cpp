#include "vascular/treatment/balloon_body.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/units.h"
#include "vascular/treatment/pressurised_tube.h"
#include "vascular/treatment/side_by_side.h"

namespace ostium::vascular {

using Eigen::Vector2d;
using units::pi;

namespace {

constexpr double settles_N_s_m2 = 1e3;  // c: with a soft wall's 5e5 N/m2 it has settled after 2 ms [numerics]
constexpr double skin_N_m2 = 1e5;       // of the shaft against the skin round it [numerics]
constexpr double beside_N_m2 = 5e5;     // with which what lies beside it holds it in its place [numerics]
constexpr double least_apart_m = 1e-6;  // from which on it is known on which side that is
constexpr double most_N = 3;            // a shaft kinks at higher force [estimate]

/// Gauss and Legendre, on [0, 1].
constexpr std::array<double, 8> gauss_at = {0.019855071751232, 0.101666761293187, 0.237233795041836, 0.408282678752175,
                                            0.591717321247825, 0.762766204958164, 0.898333238706813, 0.980144928248768};
constexpr std::array<double, 8> gauss_weight = {0.050614268145188, 0.111190517226687, 0.156853322938944,
                                                0.181341891689181, 0.181341891689181, 0.156853322938944,
                                                0.111190517226687, 0.050614268145188};

/// Solves the symmetric system with two diagonals beside the main one; overwrites it.
void solve_banded(BalloonScratch& x) {
  std::vector<double>&d = x.diagonal, &e = x.next, &f = x.second;
  for (int i = 0; i < balloon_spheres; ++i) {
    for (int k : {1, 2}) {
      if (i + k >= balloon_spheres) break;
      const double off = k == 1 ? e[i] : f[i], share = off / d[i];
      d[i + k] -= share * off;
      x.load[i + k] -= share * x.load[i];
      if (k == 1 && i + 2 < balloon_spheres) e[i + 1] -= share * f[i];
    }
  }
  for (int i = balloon_spheres - 1; i >= 0; --i) {
    if (i + 1 < balloon_spheres) x.load[i] -= e[i] * x.load[i + 1];
    if (i + 2 < balloon_spheres) x.load[i] -= f[i] * x.load[i + 2];
    x.load[i] /= d[i];
  }
}

/// What the shaft pulls a sphere to, per length: its bonds at both ends; in between, the skin that it presses on.
struct ShaftSpring {
  double N_m2 = 0;
  Vector2d to_m = Vector2d::Zero();
};
ShaftSpring shaft_spring(const BalloonModel& m, const ShaftPlace& shaft, const BalloonState& s, int i) {
  if (i == 0 || i == balloon_spheres - 1) return {m.bond_N_m / spacing_m(m), shaft.aside_m[i]};
  const Vector2d off = s.aside_m[i] - shaft.aside_m[i];
  const double far_m = off.norm(), loose_m = std::max(0.0, s.radius_m[i] - m.shaft_m);
  if (far_m <= loose_m) return {};
  return {skin_N_m2, shaft.aside_m[i] + loose_m / far_m * off};
}

/// Where its middle lies if another is beside it: away from that, so that the two lie round the lumen's middle.
Vector2d place_beside_m(const Beside& beside, const ShaftPlace& shaft, const BalloonState& s, int i) {
  const double a = s.radius_m[i], b = beside.radius_m[i];
  Vector2d from = s.aside_m[i] - beside.aside_m[i];
  if (from.norm() < least_apart_m) from = shaft.aside_m[i] - beside.aside_m[i];
  if (from.norm() < least_apart_m) from = Vector2d::UnitX();
  return b / (a + b) * side_by_side(a, b, s.flat_rad[i]).apart_m * from.normalized();
}

}  // namespace

CircleAside press_circle(const WallLaw& wall, double from_m, double a, double y) {
  CircleAside out;
  if (a + y <= from_m) return out;
  // Up to the angle to which it touches.
  const double to = a - y >= from_m ? pi : std::acos((from_m - a) / y);
  const double elsewhere_Pa = wall.at(from_m).p_Pa;
  for (std::size_t k = 0; k < gauss_at.size(); ++k) {
    const double c = std::cos(to * gauss_at[k]), share = gauss_weight[k] * to / pi;
    const WallPressure p = wall.at(a + y * c);
    out.back_N_m += share * 2 * pi * a * (p.p_Pa - elsewhere_Pa) * c;
    out.back_N_m2 += share * 2 * pi * a * p.slope_Pa_m * c * c;
  }
  return out;
}

void lie_aside(const BalloonModel& m, const ShaftPlace& shaft, const Beside& beside, double dt, BalloonScratch& x,
               BalloonState& s) {
  const double ds = spacing_m(m);
  x.diagonal.assign(balloon_spheres, settles_N_s_m2 / dt), x.next.assign(balloon_spheres, 0),
      x.second.assign(balloon_spheres, 0);
  x.load.resize(balloon_spheres);
  for (int i = 0; i < balloon_spheres; ++i) {
    x.load[i] = settles_N_s_m2 / dt * s.aside_m[i];
    // The wall: back to the middle, stiffer across than along where it touches on one side.
    const double y = s.aside_m[i].norm();
    const double stiff = std::max(x.back_N_m2[i], y > 0 ? x.back_N_m[i] / y : 0);
    x.diagonal[i] += stiff;
    if (y > 0) x.load[i] += (stiff - x.back_N_m[i] / y) * s.aside_m[i];
    const ShaftSpring spring = shaft_spring(m, shaft, s, i);
    x.diagonal[i] += spring.N_m2, x.load[i] += spring.N_m2 * spring.to_m;
    if (beside.radius_m.empty() || beside.radius_m[i] <= 0) continue;
    x.diagonal[i] += beside_N_m2, x.load[i] += beside_N_m2 * place_beside_m(beside, shaft, s, i);
  }
  for (int j = 1; j + 1 < balloon_spheres; ++j) {
    const PressurisedTube tube = pressurised_tube(s.radius_m[j], s.pressure_Pa, skin_N_m(m));
    if (!(tube.EI_N_m2 > 0)) continue;
    const Vector2d u = shaft.bend_1_m[j];
    const double bent = (u + (s.aside_m[j - 1] - 2 * s.aside_m[j] + s.aside_m[j + 1]) / (ds * ds)).norm();
    const double EI = bent > 0 ? moment_Nm(tube, bent) / bent : tube.EI_N_m2, b = EI / (ds * ds * ds * ds);
    x.diagonal[j - 1] += b, x.diagonal[j] += 4 * b, x.diagonal[j + 1] += b;
    x.next[j - 1] -= 2 * b, x.next[j] -= 2 * b, x.second[j - 1] += b;
    const Vector2d straight = EI / (ds * ds) * u;
    x.load[j - 1] -= straight, x.load[j] += 2 * straight, x.load[j + 1] -= straight;
  }
  solve_banded(x);
  std::copy(x.load.begin(), x.load.end(), s.aside_m.begin());
  // The shaft bears at its bonds what the body presses it with; where no wall bears the body, it presses on nothing.
  std::array<Vector2d, 2> force_N = {Vector2d::Zero(), Vector2d::Zero()};
  std::array<double, 2> wall_N_m{};
  for (int i = 0; i < balloon_spheres; ++i) {
    const std::size_t end = i < balloon_spheres / 2 ? 0 : 1;
    const ShaftSpring spring = shaft_spring(m, shaft, s, i);
    force_N[end] += ds * spring.N_m2 * (s.aside_m[i] - spring.to_m);
    wall_N_m[end] += ds * x.back_N_m2[i];
  }
  for (std::size_t end : {0u, 1u}) {
    s.bonds_m[end] = shaft.aside_m[end == 0 ? 0 : balloon_spheres - 1];
    s.bonds_N_m[end] = wall_N_m[end] > 0 ? 1 / (1 / m.bond_N_m + 1 / wall_N_m[end]) : 0;
    if (s.bonds_N_m[end] > 0) s.bonds_m[end] += force_N[end] / s.bonds_N_m[end];
  }
}

void slide(const BalloonModel& m, const ShaftPlace& shaft, const Along& along, double dt, BalloonState& s) {
  const double bond = 1 / (1 / m.bond_N_m + 1 / shaft.holds_N_m);
  const double holds = m.friction * (along.pressed_N + along.beside_N) + along.links_N;
  s.held = holds > 0;
  s.holds_N = std::min(holds, most_N);
  if (!s.held) return;
  // Its shaft drags it as fast as it moves, the wall pushes it slowly.
  const double reach_m = s.holds_N / bond;
  s.seat_m = std::clamp(s.seat_m, shaft.middle_m - reach_m, shaft.middle_m + reach_m);
  const double wanted = along.axial_N + bond * (shaft.middle_m - s.seat_m);
  if (const double over = std::fabs(wanted) - holds; over > 0)
    s.seat_m += std::copysign(over, wanted) * dt / (m.slide_N_s_m + bond * dt);
}

}  // namespace ostium::vascular
