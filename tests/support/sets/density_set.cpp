#include "tests/support/sets/density_set.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "tests/support/made_json.h"

namespace ostium::bench_sets {

namespace {

using List = std::vector<double>;

struct Run {
  double rate = 0, phase_s = 0, frames_per_s = 0, flow = 0, guess = 0;
  List time_s;
};

/// What is true; by default what is declared. mm, s, mg, mL.
struct Truth {
  double ostium_mm = 3.6, end_mm = 1.9, length_mm = 110;
  double beats = 70, low = 0.45, sys = 0.37;
  List sites;
  double gain_mm2_mg = 1.2, dispersion = 15, noise = 0.03;
  std::vector<Run> runs;
  double iodine = 1, back = 0, glare = 0, halo = 0, clock = 1, film_s = 0, injection_s = 0;
  double rise = 0, rise_s = 2;
  double inflow_at = 1e9, inflow = 0, branch_at = 1e9, branch = 0;
  double waist_at = 0, waist_half = 1, waist = 0;  // a cosine of this share of the diameter
  double short_from = 0, short_to = 0, shorter = 1;

  double diameter(double s) const {
    const double x = std::min(s, length_mm), u = std::fabs(s - waist_at) / waist_half;
    const double declared = ostium_mm + (end_mm - ostium_mm) * x / length_mm;
    return declared * (u < 1 ? 1 - waist * 0.5 * (1 + std::cos(3.14159265358979 * u)) : 1);
  }
  double area(double s) const { return 0.7853981633974483 * diameter(s) * diameter(s); }
  /// Slow in systole, fast in diastole.
  double shape(double phase) const {
    const double p = phase - std::floor(phase);
    if (p < sys) return low * (1 + 0.55 * std::sin(3.14159265358979 * p / sys));
    const double x = (p - sys) / (1 - sys);
    return 0.95 + 0.75 * std::exp(-std::pow((x - 0.27) / 0.18, 2));
  }
  double true_site(double seen) const {
    if (seen <= short_from) return seen;
    const double within = std::min(seen - short_from, shorter * (short_to - short_from));
    return short_from + within / shorter + std::max(seen - short_from - within, 0.0);
  }
  bool seen_shorter(double s) const { return s > short_from && s < short_to; }
};

/// Iodine along the volume that passed the ostium, in cells.
struct Plug {
  double cell = 5;  // mm3
  List iodine;      // mg/mm3

  /// One implicit step of diffusion over `D`, mm6.
  void spread(double D) {
    const double a = D / (cell * cell);
    const std::size_t n = iodine.size();
    static thread_local List upper;
    upper.resize(n);
    double before = 0, carried = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double middle = 1 + (i == 0 || i + 1 == n ? a : 2 * a);
      const double pivot = middle - a * before;
      before = upper[i] = a / pivot;
      carried = iodine[i] = (iodine[i] + a * carried) / pivot;
    }
    for (std::size_t i = n - 1; i-- > 0;) iodine[i] += upper[i] * iodine[i + 1];
  }
  double at(double volume) const {
    const double place = volume / cell - 0.5;
    const auto i = static_cast<long>(std::floor(place));
    if (i < 0 || i + 1 >= static_cast<long>(iodine.size())) return 0;
    const double part = place - static_cast<double>(i);
    return (1 - part) * iodine[static_cast<std::size_t>(i)] + part * iodine[static_cast<std::size_t>(i) + 1];
  }
};

constexpr double inj_start = 0.5, inj_length = 2.2, inj_ramp = 0.2, strength_mg_mL = 350;
constexpr double lead = 600;  // mm3 before anything, so that nothing is smeared beyond the end

/// Densities, a curve for each site.
std::vector<List> film(const Truth& t, const Run& run) {
  const double beat = 60 / t.beats, dt = 0.5e-3;
  const auto clock = [&](double frame) { return t.clock * frame + t.film_s; };
  const double first = std::min(0.0, clock(run.time_s.front())), last = clock(run.time_s.back()) + 0.01;
  List passed = {lead};
  Plug plug;
  double opened = 0;  // of what the small vessels can open
  for (double time = first; time < last; time += dt) {
    const double now = time + dt / 2, since = now - inj_start - t.injection_s;
    if (since > 0) opened += dt * (1 - opened) / t.rise_s;
    const double q = 1000 * run.flow * t.shape((now + run.phase_s) / beat) * (1 + t.rise * opened);
    const double up = std::clamp(since / inj_ramp, 0.0, 1.0),
                 down = std::clamp((inj_length - since) / inj_ramp, 0.0, 1.0);
    const double r = 1000 * run.rate * (1 - t.back) * std::min(up, down);
    const double c = t.iodine * strength_mg_mL / 1000 * std::min(1.0, r / q);
    // What passes in this step is shared out to the cells that it reaches.
    double from = passed.back();
    const double to = from + q * dt;
    passed.push_back(to);
    plug.iodine.resize(static_cast<std::size_t>(to / plug.cell) + 2, 0);
    while (from < to) {
      const auto i = static_cast<std::size_t>(from / plug.cell + 1e-9);
      const double end = std::min(to, static_cast<double>(i + 1) * plug.cell);
      plug.iodine[i] += c * (end - from) / plug.cell;
      from = end > from ? end : to;
    }
  }
  plug.iodine.resize(plug.iodine.size() + static_cast<std::size_t>(lead / plug.cell), 0);
  std::vector<List> out;
  const double slice = 0.5;
  double s = 0, way = 0;
  for (const double seen : t.sites) {
    const double to = t.true_site(seen);
    while (s < to - 1e-9) {
      const double ds = std::min(slice, to - s), middle = s + ds / 2;
      const double share = (middle > t.branch_at ? 1 - t.branch : 1) * (middle > t.inflow_at ? 1 + t.inflow : 1);
      const double volume = t.area(middle) * ds / share;
      way += volume, s += ds;
      plug.spread(t.dispersion * volume / share);
    }
    List curve;
    for (const double frame : run.time_s) {
      const double index = (clock(frame) - first) / dt, part = index - std::floor(index);
      const auto i = static_cast<std::size_t>(index);
      const double volume = passed[i] + part * (passed[std::min(i + 1, passed.size() - 1)] - passed[i]);
      const double thin = to > t.inflow_at ? 1 / (1 + t.inflow) : 1;
      curve.push_back(t.gain_mm2_mg * plug.at(volume - way) * thin * t.area(to) / (t.seen_shorter(to) ? t.shorter : 1));
    }
    out.push_back(curve);
  }
  for (std::size_t k = 0; k < run.time_s.size(); ++k) {
    double mean = 0;
    for (const List& curve : out) mean += curve[k] / static_cast<double>(out.size());
    for (List& curve : out) curve[k] += t.halo * mean + t.glare;
  }
  return out;
}

List all(const Truth& t) {
  List out;
  for (const Run& run : t.runs)
    for (const List& curve : film(t, run)) out.insert(out.end(), curve.begin(), curve.end());
  return out;
}

using Dice = std::mt19937;
double uniform(Dice& dice, double from, double to) { return std::uniform_real_distribution<double>(from, to)(dice); }
double sign(Dice& dice) { return dice() & 1u ? 1 : -1; }

Truth declared(Dice& dice) {
  Truth t;
  t.ostium_mm = uniform(dice, 3.2, 4.4), t.end_mm = uniform(dice, 1.7, 2.2), t.length_mm = uniform(dice, 90, 120);
  t.beats = uniform(dice, 55, 90), t.low = uniform(dice, 0.35, 0.6);
  t.dispersion = uniform(dice, 8, 25);
  for (const double share : {0.07, 0.27, 0.5, 0.73, 0.95})
    t.sites.push_back(std::round(t.length_mm * (share + uniform(dice, -0.02, 0.02))));
  const double rest = uniform(dice, 1.0, 2.2);
  const int runs = 4;
  for (int r = 0; r < runs; ++r) {
    Run run;
    run.rate = std::vector<double>{1.2, 2.0, 2.5, 1.5}[static_cast<std::size_t>(r)];
    run.flow = rest * uniform(dice, 0.85, 1.15) * (r == 2 ? uniform(dice, 1.8, 2.6) : 1);
    run.guess = std::round(run.flow * std::exp(0.15 * std::normal_distribution<double>()(dice)) * 10) / 10;
    run.phase_s = uniform(dice, 0, 60 / t.beats);
    run.frames_per_s = r == 3 ? 15 : 30;
    for (int k = 0; k < 5.5 * run.frames_per_s; ++k) run.time_s.push_back(std::round(k / run.frames_per_s * 1e4) / 1e4);
    t.runs.push_back(run);
  }
  return t;
}

/// Something undeclared, the more so the larger x is, from 0 to 1.
using Change = std::function<void(Truth&, double x)>;

Change change(const std::string& effect, const Truth& t, Dice& dice) {
  const double way = sign(dice), place = uniform(dice, 0.15, 0.85) * t.length_mm, time = uniform(dice, 1, 4);
  const std::size_t site = 1 + dice() % 3;
  if (effect == "collateral_inflow") return [=](Truth& u, double x) { u.inflow_at = place, u.inflow = 1.2 * x; };
  if (effect == "side_branch") return [=](Truth& u, double x) { u.branch_at = place, u.branch = 0.7 * x; };
  if (effect == "reflux") return [](Truth& u, double x) { u.back = 0.7 * x; };
  if (effect == "concentration") return [=](Truth& u, double x) { u.iodine = std::exp(way * 0.7 * x); };
  if (effect == "veiling_glare constant") return [=](Truth& u, double x) { u.glare = 0.6 * x; };
  if (effect == "veiling_glare of neighbours") return [=](Truth& u, double x) { u.halo = 0.5 * x; };
  if (effect == "narrowing")
    return [=](Truth& u, double x) {
      u.waist_at = t.sites[site] + 3 * (place / t.length_mm - 0.5), u.waist_half = 12, u.waist = 0.6 * x;
    };
  if (effect == "frame_rate") return [=](Truth& u, double x) { u.clock = std::exp(way * 0.5 * x); };
  if (effect == "trigger_delay of the film") return [=](Truth& u, double x) { u.film_s = way * 0.4 * x; };
  if (effect == "trigger_delay of the injection") return [=](Truth& u, double x) { u.injection_s = way * 0.4 * x; };
  if (effect == "contrast_hyperaemia") return [=](Truth& u, double x) { u.rise = 0.9 * x, u.rise_s = time; };
  if (effect == "foreshortening everywhere")
    return [](Truth& u, double x) { u.short_to = 1e4, u.short_from = 0, u.shorter = 1 - 0.45 * x; };
  if (effect == "foreshortening of a stretch")
    return [=](Truth& u, double x) {
      u.short_from = 0.6 * place, u.short_to = 0.6 * place + 0.4 * t.length_mm, u.shorter = 1 - 0.45 * x;
    };
  return [](Truth&, double) {};
}

/// Root mean square of what the change adds beyond what other flows could.
double left(const Truth& t, const List& without, const std::vector<List>& by_flow, const Change& to, double x) {
  Truth u = t;
  to(u, x);
  List y = all(u);
  for (std::size_t i = 0; i < y.size(); ++i) y[i] -= without[i];
  for (const List& d : by_flow) {
    double yd = 0, dd = 0;
    for (std::size_t i = 0; i < y.size(); ++i) yd += y[i] * d[i], dd += d[i] * d[i];
    for (std::size_t i = 0; i < y.size(); ++i) y[i] -= yd / dd * d[i];
  }
  double sum = 0;
  for (const double v : y) sum += v * v;
  return std::sqrt(sum / static_cast<double>(y.size()));
}

double strength_for(const Truth& t, const Change& to, double over_noise) {
  const double aim = t.noise * std::sqrt(over_noise * over_noise - 1);
  const List without = all(t);
  std::vector<List> by_flow;  // a run's flow changes only that run: these are orthogonal
  for (std::size_t r = 0; r < t.runs.size(); ++r) {
    Truth u = t;
    u.runs[r].flow *= 1.002;
    by_flow.push_back(all(u));
    for (std::size_t i = 0; i < without.size(); ++i) by_flow.back()[i] -= without[i];
  }
  double low = 0, high = 1;
  for (int i = 0; i < 9; ++i) (left(t, without, by_flow, to, (low + high) / 2) < aim ? low : high) = (low + high) / 2;
  return (low + high) / 2;
}

std::string file(const Truth& t, const Truth& is, Dice& dice) {
  MadeJson out;
  out.text("schema", "ostium-measurement/2").text("kind", "density").text("title", "made up");
  MadeJson artery, shape, detector;
  List places, diameters, phases, relative;
  for (double s = 0; s <= t.length_mm + 1e-9; s += t.length_mm / 20) {
    places.push_back(s), diameters.push_back(t.diameter(s));
  }
  for (int k = 0; k <= 50; ++k) phases.push_back(k / 50.0), relative.push_back(t.shape(k / 50.0 + 1e-9));
  out.object("artery", artery.list("from_ostium_mm", places).list("diameter_mm", diameters));
  out.list("sites_mm", t.sites).number("beats_per_min", t.beats);
  out.object("flow_shape", shape.list("phase", phases).list("relative", relative));
  out.object("detector", detector.number("mm2_per_mg", t.gain_mm2_mg).raw("linear", "true"));
  out.number("dispersion_mm3", t.dispersion).number("noise_sigma_mm", t.noise);
  std::normal_distribution<double> noise(0, t.noise);
  std::vector<std::string> runs;
  for (std::size_t r = 0; r < t.runs.size(); ++r) {
    const Run& run = t.runs[r];
    MadeJson entry, injection;
    injection.number("rate_mL_s", run.rate).number("start_s", inj_start).number("length_s", inj_length);
    injection.number("ramp_s", inj_ramp).number("iodine_mg_mL", strength_mg_mL);
    entry.text("id", "i" + std::to_string(r)).object("injection", injection).number("flow_guess_mL_s", run.guess);
    entry.number("phase_s", run.phase_s).number("frames_per_s", run.frames_per_s).list("time_s", run.time_s);
    std::vector<std::string> curves;
    for (List curve : film(is, run)) {
      for (double& y : curve) y = std::round((y + noise(dice)) * 1e4) / 1e4;
      curves.push_back(made_list(curve));
    }
    runs.push_back(entry.items("density_mm", curves).done());
  }
  return out.items("runs", runs).done() + "\n";
}

}  // namespace

const std::vector<std::string>& density_effects() {
  static const std::vector<std::string> list = {"collateral_inflow",
                                                "side_branch",
                                                "reflux",
                                                "concentration",
                                                "veiling_glare constant",
                                                "veiling_glare of neighbours",
                                                "narrowing",
                                                "frame_rate",
                                                "trigger_delay of the film",
                                                "trigger_delay of the injection",
                                                "contrast_hyperaemia",
                                                "foreshortening everywhere",
                                                "foreshortening of a stretch"};
  return list;
}

MadeSet density_set(const std::string& effect, double over_noise, unsigned seed) {
  Dice dice(seed);
  const Truth t = declared(dice);
  MadeSet out;
  const Change to = change(effect, t, dice);
  if (!effect.empty()) out.strength = over_noise > 0 ? strength_for(t, to, over_noise) : uniform(dice, 0.4, 0.8);
  Truth is = t;
  to(is, out.strength);
  for (const Run& run : t.runs) out.flow_mL_s.push_back(run.flow);
  out.json = file(t, is, dice);
  return out;
}

}  // namespace ostium::bench_sets
