#include "vascular/treatment/stent.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/base/units.h"
#include "vascular/treatment/carried_rings.h"
#include "vascular/treatment/side_by_side.h"

namespace ostium::vascular {

namespace {

using units::pi;
constexpr double yields_from = 0.9;  // of the strain at which it does
constexpr int relaxations = 3;       // rounds per step

double half_chord(const StentModel& m, double r) { return 2 * r * std::sin(pi / (2 * m.crowns)); }

double ring_height(const StentModel& m, double r) {
  const double l = m.strut_length_m(), c = half_chord(m, r);
  return std::sqrt(std::max(0.0, l * l - c * c));
}

/// Resistance of a ring at radius r.
WallPressure hoop(const StentModel& m, double rest, double r) {
  double e = std::clamp((r - rest) / rest, -m.yield, m.yield);
  WallPressure out{m.hoop_Pa * e, m.hoop_Pa / rest};
  const double limit = m.locks_at * m.widest_m();
  if (r > limit) {
    out.p_Pa += m.lock_stiffening * m.hoop_Pa * (r - limit) / limit;
    out.slope_Pa_m += m.lock_stiffening * m.hoop_Pa / limit;
  }
  return out;
}

/// The rings on both sides of a position, and the share of the way between them; false beyond the ends. `middle_m`:
/// where a ring's lies.
template <class Middle>
bool between(const StentModel& m, Middle middle_m, double s_m, int& ring, double& share) {
  double below = middle_m(0);
  if (s_m < below - m.height_m / 2 || s_m > middle_m(m.rings - 1) + m.height_m / 2) return false;
  ring = 0, share = 0;
  if (s_m <= below) return true;
  for (; ring + 1 < m.rings; ++ring) {
    const double above = middle_m(ring + 1);
    if (s_m < above) {
      share = (s_m - below) / (above - below);
      return true;
    }
    below = above;
  }
  return true;
}

}  // namespace

double StentModel::strut_length_m() const { return std::hypot(height_m, half_chord(*this, crimped_m)); }
double StentModel::widest_m() const { return strut_length_m() / (2 * std::sin(pi / (2 * crowns))); }

StentModel make_stent(double nominal_m, double length_m, const StentDesign& design) {
  StentModel m{design, {}};
  m.nominal_m = nominal_m, m.length_m = length_m;
  if (m.crowns == 0) m.crowns = nominal_m > 3.3e-3 ? 9 : 6;  // 3 links divide both
  if (m.rings == 0) m.rings = std::max(3, static_cast<int>(std::lround((length_m - m.height_m) / 1.3e-3)) + 1);
  m.name = fmt::format("cobalt-chromium stent {:g} x {:g} mm", 1e3 * nominal_m, 1e3 * length_m);
  check(m);
  return m;
}

void check(const StentModel& m) {
  if (!(m.nominal_m >= 2e-3 && m.nominal_m <= 5e-3 && m.length_m >= 6e-3 && m.length_m <= 50e-3))
    throw std::invalid_argument(
        fmt::format("stent: {:g} x {:g} mm; expected 2 to 5 mm by 6 to 50 mm", 1e3 * m.nominal_m, 1e3 * m.length_m));
  if (m.rings < 2 || m.crowns < 3 || m.crowns > most_crowns || m.links < 1 || m.crowns % m.links != 0)
    throw std::invalid_argument(
        fmt::format("stent: expected at least 2 rings, 3 to {} crowns, and links that divide the crowns", most_crowns));
}

StentState make_stent_state(const StentModel& m) {
  StentState s;
  s.radius_m.assign(m.rings, m.crimped_m), s.rest_m = s.peak_m = s.radius_m;
  s.link_m.assign(m.rings - 1, m.pitch_m());
  s.narrow.assign(m.rings, 1);
  for (int k = 0; k < m.rings; ++k)
    for (int j = 0; j < 2 * m.crowns; ++j)
      s.along_m.push_back((k - (m.rings - 1) / 2.0) * m.pitch_m() + (j % 2 ? 0.5 : -0.5) * m.height_m);
  s.pushed_m.assign(m.points(), 0), s.turned_rad = s.pushed_m;
  s.ties.assign(m.points(), {});
  return s;
}

double place_of_m(const StentState& s, int point) {
  const auto p = static_cast<std::size_t>(point);
  return s.middle_m + s.shift_m + s.along_m[p] + s.pushed_m[p];
}

double angle_of(const StentModel& m, const StentState& s, int point) {
  return pi * (point % (2 * m.crowns)) / m.crowns + s.turned_rad[static_cast<std::size_t>(point)];
}

std::pair<double, double> span_of(const StentState& s) {
  const auto [low, high] = std::minmax_element(s.along_m.begin(), s.along_m.end());
  return {s.middle_m + s.shift_m + *low, s.middle_m + s.shift_m + *high};
}

double ring_middle_m(const StentModel& m, const StentState& s, int ring) {
  double sum = 0;
  for (int j = 0; j < 2 * m.crowns; ++j) sum += s.along_m[ring * 2 * m.crowns + j];
  return s.middle_m + s.shift_m + sum / (2 * m.crowns);
}

double inner_radius_at(const StentModel& m, const StentState& s, double s_m) {
  int ring;
  double share;
  if (!between(
          m, [&](int k) { return ring_middle_m(m, s, k); }, s_m, ring, share))
    return -1;
  return share > 0 ? (1 - share) * s.radius_m[ring] + share * s.radius_m[ring + 1] : s.radius_m[ring];
}

double narrowest_m(const StentModel& m, const StentState& s, double from_m, double to_m) {
  double least = 1;
  for (int k = 0; k < m.rings; ++k)
    if (const double at = ring_middle_m(m, s, k); at >= from_m && at <= to_m) least = std::min(least, s.radius_m[k]);
  return least;
}

double area_of_ring_m2(const StentState& s, int ring) {
  // Perimeter 2 pi r = 2 pi n + 2 d and narrow / wide = 2 n / (2 n + d) give n and d.
  const auto k = static_cast<std::size_t>(ring);
  const double d_by_n = 2 * (1 / s.narrow[k] - 1), n = s.radius_m[k] / (1 + d_by_n / pi);
  return (pi + 2 * d_by_n) * n * n;
}

OpenedTo opened_to(std::span<const BalloonInside> inside, double s_m) {
  OpenedTo out;
  for (const BalloonInside& own : inside) {
    if (s_m > own.to_m) continue;
    const double a = radius_at(*own.model, *own.state, s_m), b = out.radius_m;
    if (a <= 0) continue;
    const SideBySide both = side_by_side(a, b, flat_at_rad(*own.model, *own.state, s_m));
    out = {both.lumen_m, both.narrow};
  }
  return out;
}

void add_sleeve(const StentModel& m, const StentState& s, const BalloonInside& balloon, std::span<const double> lumen_m,
                StentScratch& x, Sleeve& sleeve) {
  if (sleeve.covers.empty())
    for (auto* v : {&x.p_Pa, &x.slope_Pa_m, &x.covers, &x.inner_m, &x.fixed_Pa}) v->assign(balloon_spheres, 0);
  x.ring_m.resize(static_cast<std::size_t>(m.rings));
  for (int k = 0; k < m.rings; ++k) x.ring_m[static_cast<std::size_t>(k)] = ring_middle_m(m, s, k);
  const auto middle_m = [&](int k) { return x.ring_m[static_cast<std::size_t>(k)]; };
  const bool fixed = s.where == StentState::deployed;
  for (int b = 0; b < balloon_spheres; ++b) {
    int ring;
    double share;
    const double at_m = sphere_position(*balloon.model, *balloon.state, b);
    if (at_m > balloon.to_m || !between(m, middle_m, at_m, ring, share)) continue;
    const double a = lumen_m[b];
    const WallPressure one = hoop(m, s.rest_m[ring], a);
    const WallPressure two = share > 0 ? hoop(m, s.rest_m[ring + 1], a) : one;
    const double inner = share > 0 ? (1 - share) * s.radius_m[ring] + share * s.radius_m[ring + 1] : s.radius_m[ring];
    x.covers[b] = 1;
    x.inner_m[b] = std::max(x.inner_m[b], inner);
    x.p_Pa[b] += (1 - share) * one.p_Pa + share * two.p_Pa;
    if (fixed) x.fixed_Pa[b] += (1 - share) * one.p_Pa + share * two.p_Pa;
    x.slope_Pa_m[b] += (1 - share) * one.slope_Pa_m + share * two.slope_Pa_m;
  }
  sleeve = {x.p_Pa,    x.slope_Pa_m, std::max(sleeve.thickness_m, m.strut_m),          x.covers,
            x.inner_m, x.fixed_Pa,   std::max(sleeve.links_N, fixed ? m.crush_N : 0.0)};
}

namespace {

void move_rings(const StentModel& m, const PlaqueModel& plaque, const StentInputs& in, double dt, StentState& s,
                const PlaqueState& wall) {
  double mean = 0;
  bool any_on = false;
  for (int k = 0; k < m.rings; ++k) {
    const double at = ring_middle_m(m, s, k);
    const OpenedTo opened = opened_to(in.inside, at);
    const double a = opened.radius_m;
    double& r = s.radius_m[k];
    const WallPressure own = hoop(m, s.rest_m[k], r);
    WallPressure outside;
    if (in.path) {
      const VesselPath::Place place = in.path->at(at);
      outside = wall_pressure(plaque, wall, in.path->cells[place.index], r + m.strut_m);
    }
    // Balloon and wall both press on it; implicit in r.
    const double c = m.viscous_Pa_s_m / dt;
    const double alone = r - (own.p_Pa + outside.p_Pa) / (c + own.slope_Pa_m + outside.slope_Pa_m);
    any_on = any_on || a >= alone;
    r = std::max(alone, a);
    // While it yields it takes the shape of what opens it; one round balloon in it makes it rounder.
    if (r == a && r > (1 + yields_from * m.yield) * s.rest_m[k]) s.narrow[k] = opened.narrow;
    if (a > 0 && opened.narrow == 1) s.narrow[k] = std::max(s.narrow[k], drawn_round(a, r));
    s.rest_m[k] = std::clamp(s.rest_m[k], r / (1 + m.yield), r / (1 - m.yield));
    s.peak_m[k] = std::max(s.peak_m[k], r);
    mean += r / m.rings;
  }
  // It has opened, and no longer touches its balloon.
  if (s.where == StentState::on_balloon && !any_on && mean > 1.6 * m.crimped_m) s.where = StentState::deployed;
}

/// Relaxes struts and links to their lengths; the stent's middle is fixed.
void settle_points(const StentModel& m, StentState& s) {
  const int around = 2 * m.crowns, every = m.crowns / m.links;
  const auto pull = [](double& a, double& b, double wanted, double share) {
    const double off = share * ((b - a) - wanted) / 2;
    a += off, b -= off;
  };
  for (int round = 0; round < relaxations; ++round) {
    for (int k = 0; k < m.rings; ++k) {
      const double h = ring_height(m, s.radius_m[k]);
      double* z = &s.along_m[k * around];
      for (int j = 0; j < around; ++j) {
        const int next = (j + 1) % around;
        j % 2 ? pull(z[next], z[j], h, 0.9) : pull(z[j], z[next], h, 0.9);
      }
    }
    for (int k = 0; k + 1 < m.rings; ++k)
      for (int crown = k % 2; crown < m.crowns; crown += every) {
        const int j = (2 * crown + 1) % around;
        pull(s.along_m[k * around + j], s.along_m[(k + 1) * around + j], s.link_m[k], 0.9);
      }
  }
}

/// Points in the way of a balloon through a cell go to its edge, along the wall.
void open_cell(const StentModel& m, const ThroughCell& in, StentState& s) {
  if (in.radius_m <= 0) return;
  const int around = 2 * m.crowns;
  for (int p = 0; p < m.points(); ++p) {
    const double r = s.radius_m[p / around];
    const double x = (place_of_m(s, p) - in.at_m) / in.longer,
                 y = r * std::remainder(angle_of(m, s, p) - in.angle_rad, 2 * pi), off = std::hypot(x, y);
    if (off >= in.radius_m) continue;
    const double to = off > 1e-9 ? in.radius_m / off : 0;
    s.pushed_m[p] += to > 0 ? (to - 1) * x * in.longer : in.radius_m * in.longer;
    s.turned_rad[p] += to > 0 ? (to - 1) * y / r : 0;
  }
}

/// An edge pushes the stent distally: rings are pressed together one after another, permanently.
void crush(const StentModel& m, const StentInputs& in, StentState& s) {
  if (in.edge_N < m.crush_N) return;
  const int around = 2 * m.crowns;
  double edge = in.edge_m - s.middle_m - s.shift_m;
  for (int k = 0; k < m.rings; ++k) {
    double low = 1;
    for (int j = 0; j < around; ++j) low = std::min(low, s.along_m[k * around + j]);
    if (low >= edge) return;
    for (int j = 0; j < around; ++j) s.along_m[k * around + j] += edge - low;
    if (k + 1 == m.rings) return;
    double next = 1;
    for (int j = 0; j < around; ++j) next = std::min(next, s.along_m[(k + 1) * around + j]);
    const double least = m.pressed_together * m.pitch_m();
    s.link_m[k] = std::min(s.link_m[k], std::max(least, (next - edge) / (1 - m.link_elastic)));
    edge += least;
  }
}

}  // namespace

void step(const StentModel& m, const PlaqueModel& plaque, const StentInputs& in, double dt, StentState& s,
          PlaqueState& wall) {
  if (s.where == StentState::lost) return;
  if (s.where == StentState::on_balloon) {
    if (in.carried_by) s.middle_m = in.carried_by->seat_m;
    // Pulled against an edge it slides on its balloon, and comes off once half of it has.
    if (const double over = std::fabs(in.drag_N) - m.held_N; over > 0 && s.radius_m[m.rings / 2] < 1.2 * m.crimped_m)
      s.shift_m += std::copysign(over * dt * 5e-3, in.drag_N);
    if (std::fabs(s.shift_m) > m.length_m / 2) {
      s.where = StentState::lost;
      return;
    }
  }
  move_rings(m, plaque, in, dt, s, wall);
  if (s.where == StentState::deployed) crush(m, in, s), carry_rings(m, plaque, in, wall, s);
  settle_points(m, s);
  if (s.where == StentState::deployed) open_cell(m, in.through, s);
  if (!in.path) return;
  const auto [first, last] = span_of(s);
  for (std::size_t k = 0; k < in.path->cells.size(); ++k) {
    const double at = in.path->s_m[k];
    if (at < first || at > last) continue;
    if (const double inner = inner_radius_at(m, s, at); inner > 0)
      if (inner + m.strut_m > wall.rest_m[in.path->cells[k]])
        push_wall(plaque, in.path->cells[k], inner + m.strut_m, wall);
  }
}

}  // namespace ostium::vascular
