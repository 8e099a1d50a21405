#include "tests/support/sets/inflation_set.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "tests/support/made_json.h"

namespace ostium::bench_sets {

namespace {

using List = std::vector<double>;

struct Wall {
  double rest = 2, healthy = 3, stiffness = 1.5;  // mm, atm
};
struct Run {
  int wall = -1;
  bool stented = false;
  List time_s, pressure;
};

/// mm, atm, s.
struct Truth {
  double nominal = 3, nominal_atm = 8, growth = 0.04, bend = 0.002;
  double scale = 1;
  std::vector<Wall> walls;
  std::vector<double> wall_scale;
  std::vector<Run> runs;
  List places = {-6, 0, 6};
  double noise_mm = 0.02, noise_atm = 0.05;
  double more = 0, gauge = 0, counter = 0, back = 0, taper = 0, creep = 0;

  /// Diameter of the free balloon at a pressure: growth that slows down.
  double chart(double p) const {
    const double x = p - nominal_atm;
    return nominal + growth * x - bend * x * x / (1 + 0.1 * std::fabs(x));
  }
};

/// The pressure that a balloon needs for a diameter by itself, by halving.
double needs(const Truth& t, double d, double grown) {
  double low = -30, high = 60;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (grown * (t.scale * t.chart(middle) + t.more) < d ? low : high) = middle;
  }
  return low;
}

double bears(const Truth& t, int wall, double d) {
  const Wall& w = t.walls[static_cast<std::size_t>(wall)];
  if (d <= w.rest) return 0;
  const double x = d / w.healthy;
  return t.counter + t.wall_scale[static_cast<std::size_t>(wall)] * w.stiffness * (d - w.rest) / w.healthy +
         (x > 1 ? 0.05 * (std::exp(5 * (x * x - 1)) - 1) : 0);
}

/// The diameter at which balloon and wall are at rest.
double settles(const Truth& t, int wall, double pressure, double grown) {
  double low = 0.2, high = 9;
  for (int i = 0; i < 45; ++i) {
    const double d = (low + high) / 2;
    (needs(t, d, grown) + (wall < 0 ? 0 : bears(t, wall, d)) < pressure ? low : high) = d;
  }
  return (low + high) / 2;
}

List middles(const Truth& t, const Run& run) {
  List out;
  double grown = 1, largest = 0, at = 0;
  for (std::size_t k = 0; k < run.pressure.size(); ++k) {
    if (k > 0)
      grown += t.creep / 60 * 0.5 * (run.pressure[k] + run.pressure[k - 1]) * (run.time_s[k] - run.time_s[k - 1]);
    const double p = run.pressure[k] + t.gauge;
    double d = settles(t, run.wall, p, grown);
    if (d > largest)
      largest = d, at = p;
    else if (run.stented)
      d = std::max(d, largest - t.back * largest * (at - p) / at);
    out.push_back(d);
  }
  return out;
}

List all(const Truth& t) {
  List out;
  for (const Run& run : t.runs) {
    const List middle = middles(t, run);
    for (const double place : t.places)
      for (const double d : middle) out.push_back(d + t.taper * place);
  }
  return out;
}

using Dice = std::mt19937;
double uniform(Dice& dice, double from, double to) { return std::uniform_real_distribution<double>(from, to)(dice); }

Truth declared(Dice& dice) {
  Truth t;
  t.nominal = std::round(uniform(dice, 2.5, 4) * 4) / 4, t.nominal_atm = std::round(uniform(dice, 6, 10));
  t.growth = t.nominal * uniform(dice, 0.01, 0.02), t.bend = t.growth * uniform(dice, 0.02, 0.05);
  t.noise_mm = uniform(dice, 0.01, 0.025);
  t.walls = {{t.nominal * uniform(dice, 0.8, 0.9), t.nominal * 0.95, 1.5},
             {t.nominal * uniform(dice, 0.55, 0.75), t.nominal, 32}};
  for (std::size_t w = 0; w < t.walls.size(); ++w)
    t.wall_scale.push_back(std::exp(std::normal_distribution<double>(0, 0.25)(dice)));
  t.scale = std::exp(std::normal_distribution<double>(0, 0.02)(dice));
  const double most = t.nominal_atm + 6;
  for (int r = 0; r < 6; ++r) {
    Run run;
    run.wall = r < 2 ? -1 : r % 2;
    run.stented = r >= 4;
    const double hold = r % 2 ? 30 : 90;
    double time = 0;
    const double least = run.stented ? 0 : 2;
    for (double p = 2; p <= most + 1e-9; p += (most - 2) / 15)
      run.time_s.push_back(time += 2), run.pressure.push_back(p);
    for (int k = 0; k < 6; ++k) run.time_s.push_back(time += hold / 6), run.pressure.push_back(most);
    for (int k = 1; k <= 12; ++k)
      run.time_s.push_back(time += 1), run.pressure.push_back(most + (least - most) * k / 12.0);
    t.runs.push_back(run);
  }
  return t;
}

using Change = std::function<void(Truth&, double x)>;

Change change(const std::string& effect, Dice& dice) {
  const double way = dice() & 1u ? 1 : -1;
  if (effect == "counter_pressure") return [](Truth& u, double x) { u.counter = 4 * x; };
  if (effect == "recoil") return [](Truth& u, double x) { u.back = 0.25 * x; };
  if (effect == "chart_offset") return [=](Truth& u, double x) { u.more = way * 0.8 * x; };
  if (effect == "taper") return [=](Truth& u, double x) { u.taper = way * 0.1 * x; };
  if (effect == "gauge_offset") return [=](Truth& u, double x) { u.gauge = way * 3 * x; };
  if (effect == "creep") return [](Truth& u, double x) { u.creep = 0.01 * x; };
  return [](Truth&, double) {};
}

/// Takes out of y what the columns can follow (modified Gram-Schmidt); its root mean square then.
double left(List y, std::vector<List> columns) {
  const auto dot = [](const List& a, const List& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
  };
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const double length = dot(columns[c], columns[c]);
    const auto out_of = [&](List& v) {
      const double share = dot(v, columns[c]) / length;
      for (std::size_t i = 0; i < v.size(); ++i) v[i] -= share * columns[c][i];
    };
    for (std::size_t later = c + 1; later < columns.size(); ++later) out_of(columns[later]);
    out_of(y);
  }
  return std::sqrt(dot(y, y) / static_cast<double>(y.size()));
}

double strength_for(const Truth& t, const Change& to, double over_noise) {
  const List without = all(t);
  const auto against = [&](const Truth& u) {
    List y = all(u);
    for (std::size_t i = 0; i < y.size(); ++i) y[i] -= without[i];
    return y;
  };
  std::vector<List> columns;
  Truth u = t;
  u.scale *= 1.001, columns.push_back(against(u));
  for (std::size_t w = 0; w < t.walls.size(); ++w) u = t, u.wall_scale[w] *= 1.01, columns.push_back(against(u));
  const double noise = std::hypot(t.noise_mm, t.noise_atm * t.growth),
               aim = noise * std::sqrt(over_noise * over_noise - 1);
  double low = 0, high = 1;
  for (int i = 0; i < 9; ++i) {
    u = t, to(u, (low + high) / 2);
    (left(against(u), columns) < aim ? low : high) = (low + high) / 2;
  }
  return (low + high) / 2;
}

std::string file(const Truth& t, const Truth& is, Dice& dice) {
  MadeJson out, balloon, chart, noise;
  out.text("schema", "ostium-measurement/2").text("kind", "pressure_diameter").text("title", "made up");
  List pressures, diameters;
  for (double p = 2; p <= t.nominal_atm + 7; p += 1) pressures.push_back(p), diameters.push_back(t.chart(p));
  balloon.text("name", "balloon").number("nominal_mm", t.nominal);
  out.object("instrument",
             balloon.object("chart", chart.list("pressure_atm", pressures).list("diameter_mm", diameters)));
  std::vector<std::string> walls, runs;
  for (std::size_t w = 0; w < t.walls.size(); ++w) {
    MadeJson wall;
    wall.text("name", "v" + std::to_string(w))
        .number("rest_mm", t.walls[w].rest)
        .number("healthy_mm", t.walls[w].healthy);
    walls.push_back(wall.number("stiffness_atm", t.walls[w].stiffness).done());
  }
  out.items("vessels", walls).list("places_mm", t.places);
  out.object("noise", noise.number("pressure_atm", t.noise_atm).number("diameter_mm", t.noise_mm));
  std::normal_distribution<double> normal;
  for (std::size_t r = 0; r < t.runs.size(); ++r) {
    const Run& run = t.runs[r];
    MadeJson entry;
    entry.text("id", "b" + std::to_string(r)).text("in", run.wall < 0 ? "free" : "v" + std::to_string(run.wall));
    entry.raw("stented", run.stented ? "true" : "false").list("time_s", run.time_s).list("pressure_atm", run.pressure);
    // Noise of the gauge is seen through the growth of the balloon.
    std::vector<std::string> curves;
    const List middle = middles(is, run);
    for (const double place : t.places) {
      List curve;
      for (const double d : middle)
        curve.push_back(d + is.taper * place + t.noise_mm * normal(dice) + t.noise_atm * t.growth * normal(dice));
      curves.push_back(made_list(curve));
    }
    runs.push_back(entry.items("diameter_mm", curves).done());
  }
  return out.items("runs", runs).done() + "\n";
}

}  // namespace

const std::vector<std::string>& inflation_effects() {
  static const std::vector<std::string> list = {"counter_pressure", "recoil", "chart_offset", "taper",
                                                "gauge_offset",     "creep"};
  return list;
}

std::string inflation_set(const std::string& effect, double over_noise, unsigned seed) {
  Dice dice(seed);
  // What the declared fit may change is not as declared either.
  const Truth t = declared(dice);
  const Change to = change(effect, dice);
  Truth is = t;
  if (!effect.empty()) to(is, over_noise > 0 ? strength_for(t, to, over_noise) : uniform(dice, 0.4, 0.8));
  return file(t, is, dice);
}

}  // namespace ostium::bench_sets
