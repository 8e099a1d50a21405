#include "tests/support/sets/push_set.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/support/bench_noise.h"
#include "tests/support/dice.h"

namespace ostium::synthetic {

namespace {

using Json = nlohmann::ordered_json;
using Series = std::vector<double>;

double tube_curvature(const std::vector<TubeBend>& bends, double from, double to) {
  double out = 0;
  for (const TubeBend& b : bends)
    out += std::max(0.0, std::min(to, b.at + b.radius * b.angle) - std::max(from, b.at)) / b.radius;
  return out / (to - from);
}

/// Solves a symmetric system with five diagonals: `a` on the diagonal, `b` beside it, `c` beside that.
void solve_banded(Series a, Series b, Series c, Series& x) {
  const std::size_t n = a.size();
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double f = b[i] / a[i], g = c[i] / a[i];
    a[i + 1] -= f * b[i], b[i + 1] -= f * c[i], x[i + 1] -= f * x[i];
    if (i + 2 < n) a[i + 2] -= g * c[i], x[i + 2] -= g * x[i];
  }
  for (std::size_t i = n; i-- > 0;) {
    if (i + 1 < n) x[i] -= b[i] * x[i + 1];
    if (i + 2 < n) x[i] -= c[i] * x[i + 2];
    x[i] /= a[i];
  }
}

}  // namespace

/// Minimises bending energy over deviations within the clearance; multipliers of the walls are the forces
/// (Mehrotra 1992, SIAM J Optim 2:575, without the corrector).
std::vector<Touch> touches_of(const std::vector<TubeBend>& bends, double clearance, double from, double tip,
                              double step, double (*stiffness)(double, const void*), const void* data) {
  std::vector<Touch> out;
  const auto n = static_cast<std::size_t>(std::lround((tip - from) / step)) + 1;
  if (n < 5) return out;
  const double h = (tip - from) / static_cast<double>(n - 1);
  // Deviations in clearances, forces in units that make the energy of order one.
  const double unit = clearance / (h * h), scale = stiffness(tip - from, data) * unit * unit * h;
  Series EI(n, 0), target(n, 0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double s = from + h * static_cast<double>(i);
    EI[i] = stiffness(tip - s, data) * unit * unit * h / scale;
    target[i] = tube_curvature(bends, s - h / 2, s + h / 2) / unit;
  }
  Series diagonal(n, 1e-9), beside(n, 0), next(n, 0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    diagonal[i - 1] += EI[i], diagonal[i] += 4 * EI[i], diagonal[i + 1] += EI[i];
    beside[i - 1] -= 2 * EI[i], beside[i] -= 2 * EI[i], next[i - 1] += EI[i];
  }
  Series w(n, 0), low(n, 1e-3), high(n, 1e-3), step_w(n), with_walls(n);
  for (int iteration = 0; iteration < 120; ++iteration) {
    double mu = 0;
    for (std::size_t i = 0; i < n; ++i) mu += low[i] * (1 + w[i]) + high[i] * (1 - w[i]);
    mu *= 0.15 / (2 * static_cast<double>(n));
    if (mu < 1e-13) break;
    Series slope(n, 0);
    for (std::size_t i = 1; i + 1 < n; ++i) {
      const double moment = EI[i] * (w[i - 1] - 2 * w[i] + w[i + 1] + target[i]);
      slope[i - 1] += moment, slope[i] -= 2 * moment, slope[i + 1] += moment;
    }
    for (std::size_t i = 0; i < n; ++i) {
      step_w[i] = -slope[i] + mu / (1 + w[i]) - mu / (1 - w[i]);
      with_walls[i] = diagonal[i] + low[i] / (1 + w[i]) + high[i] / (1 - w[i]);
    }
    solve_banded(with_walls, beside, next, step_w);
    double part = 1;
    const auto limit = [&](double value, double change) {
      if (change < 0) part = std::min(part, -0.97 * value / change);
    };
    Series to_low(n), to_high(n);
    for (std::size_t i = 0; i < n; ++i) {
      to_low[i] = mu / (1 + w[i]) - low[i] - low[i] / (1 + w[i]) * step_w[i];
      to_high[i] = mu / (1 - w[i]) - high[i] + high[i] / (1 - w[i]) * step_w[i];
      limit(1 + w[i], step_w[i]), limit(1 - w[i], -step_w[i]), limit(low[i], to_low[i]), limit(high[i], to_high[i]);
    }
    for (std::size_t i = 0; i < n; ++i)
      w[i] += part * step_w[i], low[i] += part * to_low[i], high[i] += part * to_high[i];
  }
  for (std::size_t i = 0; i < n; ++i) {
    const double force = std::fabs(low[i] - high[i]) * scale / clearance;
    if (std::fabs(low[i] - high[i]) > 1e-9) out.push_back({from + h * static_cast<double>(i), force});
  }
  return out;
}

namespace {

/// What is true of the wire, the tubes and the load cell, in mm, N and s.
struct Pushed {
  double radius = 0.178, EI = 20, tip_EI = 5, tip_length = 60;
  double friction = 0.1, worn_per_mm = 0, zero = 0, drift_per_s = 0;
  double soft_length = 0, soft_share = 1, bore_more = 0;
  double sticking = 0, hand_stiffness = 0.02, sticks_below = 3;
};

struct Tube {
  std::string name;
  double bore;
  std::vector<TubeBend> bends;
};

struct Feed {
  std::size_t tube = 0;
  double start_s = 0;
  Series time_s, inserted, tip_force;
};

double stiffness_at(double from_tip, const void* data) {
  const auto& p = *static_cast<const Pushed*>(data);
  const double EI = from_tip < p.tip_length ? p.tip_EI : p.EI;
  return from_tip < p.soft_length ? EI * p.soft_share : EI;
}

/// Touches of a wire in a tube, kept for each depth.
using Known = std::map<std::pair<std::size_t, long>, std::vector<Touch>>;

const std::vector<Touch>& touches(const Pushed& p, const std::vector<Tube>& tubes, std::size_t tube, double inserted,
                                  Known& known) {
  const auto key = std::make_pair(tube, std::lround(inserted * 100));
  const auto found = known.find(key);
  if (found != known.end()) return found->second;
  const Tube& t = tubes[tube];
  const double clearance = (t.bore + p.bore_more) / 2 - p.radius;
  return known[key] = touches_of(t.bends, clearance, -10, inserted, 0.4, stiffness_at, &p);
}

/// From the tip to the hand, in short steps: each presses with what stiffness and axial force make.
double at_hand(const std::vector<Touch>& touched, const Tube& tube, double inserted, double tip_force, double mu) {
  constexpr double step = 0.25;
  double T = tip_force;
  std::size_t next = touched.size();
  for (double s = inserted; s > 0; s -= step) {
    while (next > 0 && touched[next - 1].at > s - step) T += mu * touched[--next].force;
    T += mu * std::fabs(T) * tube_curvature(tube.bends, s - step, s) * step;
  }
  while (next > 0) T += mu * touched[--next].force;
  return T;
}

std::vector<Series> measure(const Pushed& p, const std::vector<Tube>& tubes, const std::vector<Feed>& feeds,
                            Known& known) {
  std::vector<Series> out;
  double travelled = 0;
  for (const Feed& f : feeds) {
    Series force;
    double built = 0, side = 1;
    for (std::size_t k = 0; k < f.inserted.size(); ++k) {
      const double by = k > 0 ? f.inserted[k] - f.inserted[k - 1] : 0;
      const double towards = by != 0 ? (by > 0 ? 1 : -1) : 1;
      travelled += std::fabs(by);
      const double mu = p.friction * (1 + p.worn_per_mm * travelled);
      const double moving = at_hand(touches(p, tubes, f.tube, f.inserted[k], known), tubes[f.tube], f.inserted[k],
                                    f.tip_force[k], towards * mu);
      const double speed = k > 0 ? std::fabs(by) / (f.time_s[k] - f.time_s[k - 1]) : 0;
      const double most = p.sticking * std::fabs(moving - f.tip_force[k]);
      if (towards != side) built = 0;
      side = towards;
      // It stands while the hand winds it up, and slips each time that it is let go.
      double left = most > 0 && speed <= p.sticks_below ? std::fabs(by) : 0;
      if (left == 0) built = 0;
      while (left > 0) {
        const double until = std::max((most - built) / p.hand_stiffness, 0.0);
        if (until > left) {
          built += left * p.hand_stiffness, left = 0;
        } else {
          left -= until, built = 0;
        }
      }
      force.push_back(moving + side * built + p.zero + p.drift_per_s * (f.start_s + f.time_s[k]));
    }
    out.push_back(force);
  }
  return out;
}

std::vector<Tube> make_tubes(Dice& dice) {
  std::vector<Tube> out;
  const double bores[] = {1.0, 1.65, 0.7};
  for (const double bore : bores) {
    Tube t{"tube " + std::to_string(out.size()), bore, {}};
    double at = dice.uniform(30, 50);
    for (int k = 0; k < 3; ++k) {
      t.bends.push_back({at, dice.uniform(12, 35), dice.uniform(0.8, 2.2)});
      at += t.bends.back().radius * t.bends.back().angle + dice.uniform(25, 45);
    }
    out.push_back(t);
  }
  return out;
}

/// Each tube twice: free and against a force at the tip; slow, with samples 1 mm apart, and fast, 5 mm; in and back.
std::vector<Feed> design(Dice& dice) {
  std::vector<Feed> out;
  double start = 0;
  for (int r = 0; r < 6; ++r) {
    Feed f;
    f.tube = static_cast<std::size_t>(r % 3), f.start_s = start;
    const bool slow = r == 0 || r == 4;
    const double speed = slow ? 1 : 10, load = r >= 3 ? dice.uniform(0.2, 0.4) : 0;
    const double apart = slow ? 1 : 5;
    const int deepest = slow ? 240 : 48;
    double time = 0;
    for (int k = 1; k <= 2 * deepest; ++k) {
      f.inserted.push_back(apart * (k <= deepest ? k : 2 * deepest + 1 - k));
      time += apart / speed, f.time_s.push_back(time);
      // A spring before the tip, pushed only on the way in.
      f.tip_force.push_back(k <= deepest ? load * k / deepest : 0);
    }
    start += time + 60, out.push_back(f);
  }
  return out;
}

/// `amount`: 0 is nothing, 1 more than a bench has.
void switch_on(const std::string& content, double amount, double side, Dice& dice, Pushed& p) {
  const double u = dice.uniform(0, 1), v = dice.uniform(0, 1);
  if (content == "wall_friction") p.friction *= side > 0 ? 1 + 3 * amount : 1 - 0.9 * amount;
  if (content == "soft_tip") p.soft_length = 20 + 60 * u, p.soft_share = 1 - 0.97 * amount;
  if (content == "coating_loss") p.worn_per_mm = 2e-3 * amount;
  if (content == "clearance") p.bore_more = side > 0 ? amount : -0.3 * amount;
  if (content == "stick_slip") p.sticking = 2 * amount, p.hand_stiffness = 0.004 + 0.006 * v;
  if (content == "zero_offset") p.zero = 0.5 * side * amount;
  if (content == "force_drift") p.drift_per_s = 1e-3 * side * amount;
}

/// Root mean square of a difference over the noise, less what other stiffnesses would take of it.
double excess(const std::vector<Series>& with, const std::vector<Series>& plain, const std::vector<Series>& stiffer,
              double noise) {
  double dd = 0, ds = 0, ss = 0, count = 0;
  for (std::size_t r = 0; r < with.size(); ++r)
    for (std::size_t k = 0; k < with[r].size(); ++k) {
      const double d = (with[r][k] - plain[r][k]) / noise, s = (stiffer[r][k] - plain[r][k]) / noise;
      dd += d * d, ds += d * s, ss += s * s, ++count;
    }
  return std::sqrt(std::max(dd - ds * ds / ss, 0.0) / count);
}

void spoil(const std::string& content, Dice& dice, Json& runs, BenchSet& out) {
  const auto r = static_cast<std::size_t>(dice.whole(0, 5));
  const auto scaled = [&](const char* key, double factor) {
    for (Json& v : runs[r][key]) v = v.get<double>() * factor;
  };
  out.effects = {"unit_error"};
  if (content == "fault:gram_force") scaled("hand_force_N", 1 / 9.80665e-3);
  if (content == "fault:inserted_cm") scaled("inserted_mm", 0.1);
  if (content == "fault:swapped") {
    // What was measured in one tube is filed under another.
    std::size_t other = (r + 1) % runs.size();
    while (other != r && (runs[other]["path"] == runs[r]["path"] ||
                          runs[other].contains("tip_force_N") != runs[r].contains("tip_force_N")))
      other = (other + 1) % runs.size();
    for (const char* key : {"time_s", "inserted_mm", "hand_force_N", "tip_force_N"})
      if (runs[r].contains(key)) std::swap(runs[r][key], runs[other][key]);
    out.effects = {"swapped_experiments"};
  }
  if (content == "fault:outlier") scaled("hand_force_N", dice.uniform(1.2, 1.4)), out.effects = {"outlier_experiment"};
}

BenchSet make_of(const BenchWire* wire, const std::string& content, double size, unsigned seed) {
  Dice dice("push:" + content, seed);
  Pushed declared;
  declared.EI = dice.log_uniform(10, 30), declared.tip_EI = declared.EI * dice.uniform(0.15, 0.4);
  if (content == "soft_tip") declared.tip_EI = declared.EI;
  declared.tip_length = content == "soft_tip" ? 0 : dice.uniform(40, 90), declared.friction = dice.uniform(0.06, 0.15);
  Pushed plain = declared;
  plain.EI *= dice.log_uniform(0.75, 1.33), plain.tip_EI *= dice.log_uniform(0.75, 1.33);
  if (wire) {
    declared.tip_length = 0, declared.EI = declared.tip_EI = wire->declared_EI;
    declared.friction = wire->declared_friction;
    plain = declared;
    plain.EI = plain.tip_EI = wire->EI, plain.friction = wire->friction;
  }
  const std::vector<Tube> tubes = make_tubes(dice);
  const std::vector<Feed> feeds = design(dice);
  const double noise_N = 4e-3 * dice.log_uniform(0.75, 1.33), tip_noise_N = 0.003;
  Known known;
  std::vector<Series> force = measure(plain, tubes, feeds, known);
  BenchSet out;
  if (content != "clean" && content.find(':') == std::string::npos) {
    const std::vector<Series> without = force;
    Pushed other = plain;
    other.EI *= 1.05, other.tip_EI *= 1.05;
    Known known_other;
    const std::vector<Series> stiffer = measure(other, tubes, feeds, known_other);
    const bool same_shape = content != "soft_tip" && content != "clearance";
    const Dice at = dice;
    double side = Dice(at).sign();
    const auto with = [&](double amount) {
      Dice same = at;
      Pushed p = plain;
      switch_on(content, amount, side, same, p);
      Known new_shapes;
      return measure(p, tubes, feeds, same_shape ? known : new_shapes);
    };
    if (side < 0 && excess(with(1), without, stiffer, noise_N) < size) side = 1;
    double low = 0, high = 1;
    for (int i = 0; i < 8; ++i) {
      const double middle = (low + high) / 2;
      (excess(with(middle), without, stiffer, noise_N) < size ? low : high) = middle;
    }
    force = with((low + high) / 2), out.effects = {content};
  }
  Json runs = Json::array();
  NoiseMaker noise(content, dice);
  for (std::size_t r = 0; r < feeds.size(); ++r) {
    const Feed& f = feeds[r];
    const Series on_hand = noise.run(f.inserted.size()), on_tip = noise.independent(f.inserted.size());
    Series hand = force[r], tip = f.tip_force;
    const bool loaded = tip[0] != 0;
    for (std::size_t k = 0; k < hand.size(); ++k) hand[k] += noise_N * on_hand[k], tip[k] += tip_noise_N * on_tip[k];
    Json bends = Json::array();
    for (const TubeBend& b : tubes[f.tube].bends)
      bends.push_back({{"at_mm", b.at}, {"radius_mm", b.radius}, {"angle_deg", b.angle * 180 / 3.14159265358979}});
    runs.push_back({{"id", "p" + std::to_string(r)},
                    {"path", {{"name", tubes[f.tube].name}, {"bore_mm", tubes[f.tube].bore}, {"bends", bends}}},
                    {"start_s", f.start_s},
                    {"time_s", f.time_s},
                    {"inserted_mm", f.inserted},
                    {"hand_force_N", hand}});
    if (loaded) runs.back()["tip_force_N"] = tip;
  }
  if (content.rfind("fault:", 0) == 0) spoil(content, dice, runs, out);
  Json sections = Json::array();
  if (declared.tip_length > 0)
    sections.push_back({{"from_tip_mm", {0, declared.tip_length}}, {"EI_Nmm2", declared.tip_EI}});
  sections.push_back({{"from_tip_mm", {declared.tip_length, 1000}}, {"EI_Nmm2", declared.EI}});
  const Json file = {
      {"schema", "ostium-measurement/2"},
      {"kind", "push_pull"},
      {"title", "push and pull"},
      {"instruments",
       {{{"name", "0.014in wire"}, {"outer_radius_mm", declared.radius}, {"length_mm", 1000}, {"sections", sections}}}},
      {"rig", {{"friction", declared.friction}}},
      {"noise",
       {{"hand_force_N", noise_N * noise.declared_share()}, {"tip_force_N", tip_noise_N * noise.declared_share()}}},
      {"runs", runs}};
  out.json = file.dump();
  return out;
}

BenchSet make(const std::string& content, double size, unsigned seed) { return make_of(nullptr, content, size, seed); }

}  // namespace

BenchSet push_of(const BenchWire& wire, unsigned seed) { return make_of(&wire, "clean", 0, seed); }

BenchKind push_kind() {
  return {"push_pull",
          {"clean", "noise:shared", "noise:heavy", "noise:twice", "wall_friction", "soft_tip", "coating_loss",
           "clearance", "stick_slip", "zero_offset", "force_drift", "fault:gram_force", "fault:inserted_cm",
           "fault:swapped", "fault:outlier"},
          make};
}

}  // namespace ostium::synthetic
