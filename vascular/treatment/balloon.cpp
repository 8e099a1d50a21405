#include "vascular/treatment/balloon.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>

#include "core/base/random.h"
#include "core/base/units.h"
#include "vascular/treatment/balloon_body.h"
#include "vascular/treatment/side_by_side.h"

namespace ostium::vascular {

namespace {

using units::atm;

using units::pi;
constexpr int n = balloon_spheres;
constexpr double fold_share = 0.25;            // share of the unfolding pressure needed to start opening the folds
constexpr double sealed_m = 20e-6;             // a gap this narrow counts as sealed
constexpr double soft_m = 30e-6;               // distance over which balloon and stent come to bear on the wall
constexpr double packed_Pa = 100 * atm;        // stiffness of folds that lie one on the other [estimate]
constexpr double flattens_s = 5e-3;            // in which two balloons side by side flatten each other [numerics]
constexpr double least_filled_Pa = 0.1 * atm;  // with less, a wall flattens it altogether
constexpr double wedge_ahead_m = 1.5e-3, wedge_gap_m = 30e-6;  // more than a session's wall lags

/// Radius when just unfolded, at the unfolding pressure.
double unfolded_m(const BalloonModel& m) {
  return m.nominal_m / 2 - m.growth_m_Pa / 2 * (m.nominal_Pa - m.unfolding_Pa);
}

/// Pressure that the balloon's skin balances at radius a, and its slope.
WallPressure skin(const BalloonModel& m, double share, bool was_filled, double a) {
  const double full = m.shaft_m + share * (unfolded_m(m) - m.shaft_m);
  const double folded = std::min(was_filled ? m.refolded_m : m.folded_m, full);
  if (a >= full) {
    const double slope = 2 / (m.growth_m_Pa * std::max(share, 0.3));
    return {m.unfolding_Pa + slope * (a - full), slope};
  }
  // The factory folds stay closed until a small pressure opens them; once opened, they need vacuum to fold again.
  const double way = std::max(full - folded, 20e-6), x = (a - folded) / way, packed = std::min(m.folded_m, full);
  if (a < packed) return {x * 4 * atm + packed_Pa * (a / packed - 1), 4 * atm / way + packed_Pa / packed};
  if (x < 0) return {x * 4 * atm, 4 * atm / way};
  const double low = fold_share * m.unfolding_Pa - (was_filled ? 0.35 * atm : 0);
  return {low + x * (m.unfolding_Pa - low), (m.unfolding_Pa - low) / way};
}

}  // namespace

BalloonModel make_balloon(Compliance compliance, double nominal_m, double length_m, const BalloonDesign& design) {
  BalloonModel m{design, {}};
  const bool semi = compliance == Compliance::semi;
  m.nominal_m = nominal_m, m.length_m = length_m;
  m.nominal_Pa = (semi ? 8 : 12) * atm, m.rated_Pa = (semi ? 14 : 20) * atm;
  if (m.growth_m_Pa == 0) m.growth_m_Pa = nominal_m / 3e-3 * (semi ? 0.25e-3 / 6 : 0.10e-3 / 8) / atm;
  m.name = fmt::format("{} {:g} x {:g} mm", semi ? "semi-compliant" : "non-compliant", 1e3 * nominal_m, 1e3 * length_m);
  check(m);
  return m;
}

void check(const BalloonModel& m) {
  const auto within = [&](double value, double low, double high, const char* what) {
    if (!(value >= low && value <= high))
      throw std::invalid_argument(fmt::format("balloon: {} of {:g}; expected {:g} to {:g}", what, value, low, high));
  };
  within(m.nominal_m, 1e-3, 8e-3, "a nominal diameter (m)");
  within(m.length_m, 5e-3, 60e-3, "a length (m)");
  within(m.rated_Pa, m.nominal_Pa, 30 * atm, "a rated pressure (Pa)");
  within(m.growth_m_Pa, 1e-12, 1e-8, "a growth of diameter (m/Pa)");
}

double chart_diameter_m(const BalloonModel& m, double gauge_Pa) {
  return m.nominal_m + m.growth_m_Pa * (gauge_Pa - m.nominal_Pa);
}

double burst_Pa(const BalloonModel& m) { return m.rated_Pa * (1.05 + 0.3 * core::uniform(m.seed, 31, 0)); }

BalloonState make_balloon_state(const BalloonModel& m) {
  BalloonState s;
  s.radius_m.assign(n, 0);
  for (int i = 0; i < n; ++i) {
    s.radius_m[i] = std::min(m.folded_m, m.shaft_m + sphere_share(m, i) * (m.folded_m - m.shaft_m));
    s.volume_m3 += pi * s.radius_m[i] * s.radius_m[i] * spacing_m(m);
  }
  s.largest_m = m.folded_m;
  s.aside_m.assign(n, Eigen::Vector2d::Zero());
  s.flat_rad.assign(n, 0);
  return s;
}

void follow_shaft(double shaft_middle_m, BalloonState& s) {
  if (!s.held) s.seat_m = shaft_middle_m;
}

double spacing_m(const BalloonModel& m) { return (m.length_m + 2 * m.shoulder_m) / (n - 1); }

double skin_N_m(const BalloonModel& m) { return m.nominal_m * m.nominal_m / 2 / m.growth_m_Pa; }

double sphere_position(const BalloonModel& m, const BalloonState& s, int i) {
  return s.seat_m - m.length_m / 2 - m.shoulder_m + i * spacing_m(m);
}

double sphere_share(const BalloonModel& m, int i) {
  const double from_end = std::min(i, n - 1 - i) * spacing_m(m);
  return from_end >= m.shoulder_m ? 1 : (1 - std::cos(pi * from_end / m.shoulder_m)) / 2;
}

Eigen::Vector2d aside_at_m(const BalloonModel& m, const BalloonState& s, double s_m) {
  const double x = std::clamp((s_m - sphere_position(m, s, 0)) / spacing_m(m), 0.0, n - 1.0);
  const int i = std::min(static_cast<int>(x), n - 2);
  return s.aside_m[i] + (x - i) * (s.aside_m[i + 1] - s.aside_m[i]);
}

namespace {

/// A value of the spheres at a position of the path, 0 beyond the balloon's ends.
double value_at(const BalloonModel& m, const BalloonState& s, std::span<const double> of_spheres, double s_m) {
  const double x = (s_m - sphere_position(m, s, 0)) / spacing_m(m);
  if (x < 0 || x > n - 1) return 0;
  const int i = std::min(static_cast<int>(x), n - 2);
  return of_spheres[i] + (x - i) * (of_spheres[i + 1] - of_spheres[i]);
}

}  // namespace

double radius_at(const BalloonModel& m, const BalloonState& s, double s_m) { return value_at(m, s, s.radius_m, s_m); }

double flat_at_rad(const BalloonModel& m, const BalloonState& s, double s_m) { return value_at(m, s, s.flat_rad, s_m); }

namespace {

/// The wall between two cells of the path, interpolated.
WallPressure wall_at(const PlaqueModel& plaque, const PlaqueState& wall, const VesselPath& path, double s_m, double a) {
  const VesselPath::Place at = path.at(s_m);
  const WallPressure one = wall_pressure(plaque, wall, path.cells[at.index], a);
  if (at.share == 0) return one;
  const WallPressure two = wall_pressure(plaque, wall, path.cells[at.index + 1], a);
  return {(1 - at.share) * one.p_Pa + at.share * two.p_Pa, (1 - at.share) * one.slope_Pa_m + at.share * two.slope_Pa_m};
}

/// What pushes a sphere back to the middle, in the same way. `held_m`: radius to which a stent holds the wall.
CircleAside push_back(const PlaqueModel& plaque, const PlaqueState& wall, const VesselPath& path, double s_m, double a,
                      double aside_m, double held_m) {
  const VesselPath::Place at = path.at(s_m);
  const auto press = [&](int index) {
    const int cell = path.cells[index];
    if (a + aside_m <= std::max(held_m, wall.rest_m[cell])) return CircleAside{};
    const WallLaw law = wall_law(plaque, wall, cell);
    return press_circle(law, std::max(held_m, law.rest_m), a, aside_m);
  };
  const CircleAside one = press(at.index), two = at.share > 0 ? press(at.index + 1) : one;
  return {(1 - at.share) * one.back_N_m + at.share * two.back_N_m,
          (1 - at.share) * one.back_N_m2 + at.share * two.back_N_m2};
}

bool is_sleeved(const BalloonInputs& in, int i) { return !in.sleeve.covers.empty() && in.sleeve.covers[i] > 0; }
double beside_m(const BalloonInputs& in, int i) { return in.beside.radius_m.empty() ? 0 : in.beside.radius_m[i]; }
/// Radius of the lumen that the sphere opens, with what lies beside it.
double lumen_m(const BalloonInputs& in, const BalloonState& s, int i) {
  return beside_m(in, i) > 0 ? in.beside.lumen_m[i] : s.radius_m[i];
}

/// The wall's pressure on a sphere in the artery, to which it `meets`; keeps what pushes it back to the middle. A
/// sphere aside presses all round as if it were in the middle: that of one side alone the shaft's own contact bears.
WallPressure meet_wall(const PlaqueModel& plaque, const PlaqueState& wall, const BalloonInputs& in, double at_m,
                       const BalloonState& s, int i, double meets, BalloonScratch& x) {
  const bool sleeved = is_sleeved(in, i);
  const double outer = lumen_m(in, s, i) + (sleeved ? in.sleeve.thickness_m : 0);
  const bool in_artery = at_m >= in.path->s_m.front() && at_m <= in.path->s_m.back();
  if (const double aside_m = s.aside_m[i].norm(); aside_m > 0 && in_artery && beside_m(in, i) == 0) {
    const double held_m = sleeved ? in.sleeve.inner_m[i] + in.sleeve.thickness_m : 0;
    const CircleAside back = push_back(plaque, wall, *in.path, at_m, outer, aside_m, held_m);
    x.back_N_m[i] = back.back_N_m, x.back_N_m2[i] = back.back_N_m2;
  }
  if (meets == 0) return {};
  const WallPressure round = wall_at(plaque, wall, *in.path, at_m, outer);
  WallPressure w{meets * round.p_Pa, meets * round.slope_Pa_m};
  if (meets < 1) w.slope_Pa_m += (round.p_Pa + in.sleeve.p_Pa[i]) / soft_m;
  return w;
}

/// What a pressure on the lumen's wall, and its slope, is on the skin of a sphere: less where another lies beside it.
struct Share {
  double p = 1, slope = 1;
};
Share share_of_wall(const BalloonInputs& in, const BalloonState& s, int i) {
  if (beside_m(in, i) == 0) return {};
  const SideBySide both = side_by_side(s.radius_m[i], beside_m(in, i), s.flat_rad[i]);
  const double share = both.lumen_m / s.radius_m[i] * both.by_a;
  return {share, share * both.by_a};
}

/// The two flatten each other as far as the wall draws them together.
void flatten(const WallPressure& wall, const BalloonInputs& in, double dt, int i, BalloonState& s) {
  double rest_rad = 0;
  if (beside_m(in, i) > 0)
    rest_rad = flattened_rad(s.radius_m[i], beside_m(in, i), std::max(s.pressure_Pa, least_filled_Pa),
                             {wall.p_Pa, wall.slope_Pa_m, lumen_m(in, s, i)});
  s.flat_rad[i] += std::min(1.0, dt / flattens_s) * (rest_rad - s.flat_rad[i]);
}

/// Thomas' algorithm with two right-hand sides; overwrites everything.
void solve(BalloonScratch& x) {
  for (int i = 1; i < n; ++i) {
    const double f = x.below[i] / x.middle[i - 1];
    x.middle[i] -= f * x.above[i - 1];
    x.right[i] -= f * x.right[i - 1];
    x.unit[i] -= f * x.unit[i - 1];
  }
  for (int i = n - 1; i >= 0; --i) {
    const double next_r = i + 1 < n ? x.right[i + 1] : 0, next_u = i + 1 < n ? x.unit[i + 1] : 0;
    x.right[i] = (x.right[i] - x.above[i] * next_r) / x.middle[i];
    x.unit[i] = (x.unit[i] - x.above[i] * next_u) / x.middle[i];
  }
}

/// The shaft's tip is a cone that opens a narrowing as it goes in, for good only where the plaque yields, and what
/// follows keeps it open, with a gap, so that contact's wall, which lags, does not pinch the rod. Left out is what that
/// costs the hand, the plaque's pressure on the ring between lumen and shaft: 0.05 N for 0.6 mm in 0.5 mm.
void wedge(const BalloonModel& m, const PlaqueModel& plaque, const VesselPath& path, double middle_m,
           PlaqueState& wall) {
  if (m.tip_m <= 0) return;
  const double from_m = middle_m - m.length_m / 2, to_m = middle_m + m.length_m / 2 + m.tip_m + wedge_ahead_m,
               wanted_m = m.tip_radius_m + wedge_gap_m;
  for (std::size_t k = 0; k < path.cells.size(); ++k)
    if (path.s_m[k] > from_m && path.s_m[k] < to_m && wall.radius_m[path.cells[k]] < wanted_m)
      push_wall(plaque, path.cells[k], wanted_m, wall);
}

}  // namespace

BalloonReport step(const BalloonModel& m, const PlaqueModel& plaque, const BalloonInputs& in, double dt,
                   BalloonState& s, PlaqueState& wall, BalloonScratch& x) {
  assert(dt > 0 && dt <= 10e-3);
  BalloonReport report;
  const double ds = spacing_m(m), gauge = std::max(-atm, std::isfinite(in.gauge_Pa) ? in.gauge_Pa : 0.0);
  report.gauge_Pa = gauge;
  for (auto* v : {&x.below, &x.middle, &x.above, &x.right, &x.unit, &x.back_N_m, &x.back_N_m2}) v->assign(n, 0);
  if (s.pressure_Pa > burst_Pa(m)) s.burst = true;
  const bool was_filled = s.was_filled;
  Along along;
  double ring_N = 0;
  Eigen::Vector2d aside = Eigen::Vector2d::Zero();
  for (int i = 0; i < n; ++i) {
    const double a = s.radius_m[i], share = sphere_share(m, i), at = sphere_position(m, s, i);
    WallPressure sum = skin(m, share, was_filled, a), outside;
    const bool sleeved = is_sleeved(in, i);
    const Share bears = share_of_wall(in, s, i);
    const auto add = [&](double p_Pa, double slope_Pa_m) {
      sum.p_Pa += bears.p * p_Pa, sum.slope_Pa_m += bears.slope * slope_Pa_m, outside.p_Pa += p_Pa,
          outside.slope_Pa_m += slope_Pa_m;
    };
    // Inside a sleeve it has no contact; when it starts to touch, skin and struts yield slightly.
    const double meets = sleeved ? std::clamp(1 + (lumen_m(in, s, i) - in.sleeve.inner_m[i]) / soft_m, 0.0, 1.0) : 1;
    if (sleeved && meets > 0) add(meets * in.sleeve.p_Pa[i], meets * in.sleeve.slope_Pa_m[i]);
    if (in.path) {
      const WallPressure w = meet_wall(plaque, wall, in, at, s, i, meets, x);
      add(w.p_Pa, w.slope_Pa_m);
      report.touches = report.touches || w.p_Pa > 0;
      const double before = s.radius_m[std::max(i - 1, 0)], after = s.radius_m[std::min(i + 1, n - 1)];
      const double fixed_Pa = sleeved ? meets * in.sleeve.fixed_Pa[i] : 0;
      along.axial_N += (w.p_Pa + fixed_Pa) * 2 * pi * a * (after - before) / 2;
      if (beside_m(in, i) > 0) along.beside_N += (w.p_Pa + fixed_Pa) * 2 * a * ds;  // twice the tension round both
      along.pressed_N += w.p_Pa * 2 * pi * a * ds;
      ring_N += fixed_Pa * 2 * pi * a * ds;
      if (const double off = s.aside_m[i].norm(); off > 0) aside -= x.back_N_m[i] * ds / off * s.aside_m[i];
    }
    flatten(outside, in, dt, i, s);
    const double N = std::max(0.0, s.pressure_Pa) * a / 2 / (ds * ds), c = m.viscous_Pa_s_m / dt;
    x.below[i] = i > 0 ? -N : 0, x.above[i] = i + 1 < n ? -N : 0;
    x.middle[i] = c + sum.slope_Pa_m - x.below[i] - x.above[i];
    x.right[i] = c * a - sum.p_Pa + sum.slope_Pa_m * a;
    x.unit[i] = 1;
    if (i == 0 || i == n - 1) x.middle[i] = 1, x.below[i] = x.above[i] = 0, x.right[i] = m.shaft_m, x.unit[i] = 0;
  }
  solve(x);
  // New radii are right + p unit; choose p so that the volume matches the inflow through the shaft.
  double V = 0, V0 = 0, dV = 0;
  for (int i = 0; i < n; ++i) {
    V += pi * s.radius_m[i] * s.radius_m[i] * ds;
    V0 += 2 * pi * s.radius_m[i] * (x.right[i] - s.radius_m[i]) * ds;
    dV += 2 * pi * s.radius_m[i] * x.unit[i] * ds;
  }
  const double R = m.filling_Pa_s_m3, before_m3 = s.volume_m3;
  if (s.burst) {
    s.pressure_Pa = 0;
  } else {
    // V + V0 + p dV = volume + dt (gauge - p) / R
    s.pressure_Pa = (s.volume_m3 - V - V0 + dt * gauge / R) / (dV + dt / R);
    s.volume_m3 += dt * (gauge - s.pressure_Pa) / R;
  }
  for (int i = 0; i < n; ++i) {
    s.radius_m[i] = std::max(m.shaft_m, x.right[i] + s.pressure_Pa * x.unit[i]);
    s.largest_m = std::max(s.largest_m, s.radius_m[i]);
  }
  if (s.burst) {
    double now = 0;
    for (double a : s.radius_m) now += pi * a * a * ds;
    report.spilt_m3 = std::max(0.0, before_m3 - now);
    s.volume_m3 = std::min(before_m3, now);
  }
  if (s.pressure_Pa > m.unfolding_Pa) s.was_filled = true;
  s.inflated_s = gauge > atm ? s.inflated_s + dt : 0;
  if (in.path) {
    // What rings it presses hold to others, it is held by, as far as they do not slip on it.
    along.links_N = std::min(in.sleeve.links_N, m.friction * ring_N);
    const double seat_m = s.seat_m;
    slide(m, in.shaft, along, dt, s);
    report.slid_m = s.seat_m - seat_m;
    if (!in.shaft.aside_m.empty()) lie_aside(m, in.shaft, in.beside, dt, x, s);
    report.axial_N = along.axial_N, report.pressed_N = along.pressed_N, report.aside_N = aside.norm();
    double narrowest_gap = 1;
    for (std::size_t k = 0; k < in.path->cells.size(); ++k) {
      const double a = radius_at(m, s, in.path->s_m[k]);
      if (a <= 0) continue;
      const int i =
          std::clamp(static_cast<int>(std::lround((in.path->s_m[k] - sphere_position(m, s, 0)) / ds)), 0, n - 1);
      const double b = in.path->s_m[k] <= in.beside.to_m ? beside_m(in, i) : 0;
      const double outer = side_by_side(a, b, s.flat_rad[i]).lumen_m + (is_sleeved(in, i) ? in.sleeve.thickness_m : 0);
      if (outer > wall.radius_m[in.path->cells[k]]) push_wall(plaque, in.path->cells[k], outer, wall);
      narrowest_gap = std::min(narrowest_gap, wall.radius_m[in.path->cells[k]] - outer);
    }
    report.seals = narrowest_gap < sealed_m;
    wedge(m, plaque, *in.path, s.seat_m, wall);
  } else {
    s.held = false;
    std::fill(s.aside_m.begin(), s.aside_m.end(), Eigen::Vector2d::Zero());
  }
  double least = 1, most = 0;
  const int first = static_cast<int>(std::ceil(m.shoulder_m / ds)), last = n - 1 - first;
  for (int i = first; i <= last; ++i) least = std::min(least, s.radius_m[i]), most = std::max(most, s.radius_m[i]);
  report.waist = most > 0 ? least / most : 1;
  report.dog_bone = std::max(s.radius_m[first + 2], s.radius_m[last - 2]) / s.radius_m[n / 2];
  return report;
}

bool is_empty(const BalloonModel& model, const BalloonState& state) {
  const double most = *std::max_element(state.radius_m.begin(), state.radius_m.end());
  return state.pressure_Pa < 0.2 * units::atm && most < 1.15 * std::max(model.refolded_m, model.folded_m);
}

}  // namespace ostium::vascular
