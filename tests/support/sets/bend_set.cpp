#include "tests/support/sets/bend_set.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/support/bench_noise.h"
#include "tests/support/bend_law.h"
#include "tests/support/dice.h"

namespace ostium::synthetic {

namespace {

using Json = nlohmann::ordered_json;
using Series = std::vector<double>;

/// What is true of the wire and the rig, in mm, N and s. The file declares EI and rollers, and zeros for the rest.
struct Bench {
  double EI = 40, roller = 2;
  double friction = 0, compliance = 0, span_more = 0, zero = 0, drift_per_s = 0, relaxing = 0, relaxation_s = 20;
  // A spring beside a slider with a spring before it; at first both carry. `slider`: share of EI that slips or yields.
  double slider = 0, slips_at = 0;  ///< curvature at which it gives way
  // A flag: beyond `flag_at` the tangent is `flag_ratio` of EI; back at `flag_back` of that moment.
  double flag_at = 0, flag_back = 1, flag_ratio = 1;
  BendLaw law;  ///< if it is not linear, instead of these
};

struct Pass {
  double span = 20, from_tip = 600, start_s = 0;
  Series time_s, displacement;
};

/// A station along the half wire: where its slider stands, and how much has transformed.
struct Station {
  double slider_at = 0, transformed = 0;
  double curvature = 0;
  SlidersAt sliders_at{};
};

/// Curvature under a moment, and what the station then remembers.
double curvature(const Bench& b, double moment, Station& s) {
  if (!b.law.linear()) return b.law.curvature(moment / b.EI, s.curvature, s.sliders_at);
  if (b.flag_at > 0) {
    const double M1 = b.EI * b.flag_at, H = b.EI * b.flag_ratio / (1 - b.flag_ratio);
    if (moment > M1 + H * s.transformed) s.transformed = (moment - M1) / H;
    if (moment < b.flag_back * M1 + H * s.transformed) s.transformed = std::max((moment - b.flag_back * M1) / H, 0.0);
    return moment / b.EI + s.transformed;
  }
  if (b.slider <= 0) return moment / b.EI;
  const double k = b.slider * b.EI, rest = b.EI - k, most = k * b.slips_at;
  const double sticking = (moment + k * s.slider_at) / b.EI, carried = k * (sticking - s.slider_at);
  if (std::fabs(carried) <= most) return sticking;
  const double side = carried > 0 ? 1 : -1, slipping = (moment - side * most) / rest;
  s.slider_at = slipping - side * b.slips_at;
  return slipping;
}

constexpr int stations = 100;

struct HalfWire {
  double across = 0, drop = 0, force = 0;
};

/// From the roller, where the wire slopes by `slope` and the reaction's normal part is `normal`, to the level middle.
HalfWire integrate(const Bench& b, double span, double slope, double normal, double friction,
                   const std::vector<Station>& before, std::vector<Station>* after) {
  const double Rx = normal * (std::sin(slope) - friction * std::cos(slope)),
               Rz = normal * (std::cos(slope) + friction * std::sin(slope));
  HalfWire out;
  out.force = 2 * Rz;
  const double ds = span / 2 / stations;
  double theta = slope, s = 0;
  for (int k = 0; k < 2 * stations && theta > 0; ++k) {
    const auto curved = [&](double x, double z, double at) {
      // Stations are counted from the middle, as far away as the straight wire had it.
      const int i = std::clamp(static_cast<int>((span / 2 - at) / ds), 0, stations - 1);
      Station copy = before[static_cast<std::size_t>(i)];
      const double kappa = curvature(b, x * Rz + z * Rx, copy);
      if (after) (*after)[static_cast<std::size_t>(i)] = copy;
      return kappa;
    };
    const double half_theta = theta - curved(out.across, out.drop, s) * ds / 2;
    const double x = out.across + std::cos(theta) * ds / 2, z = out.drop + std::sin(theta) * ds / 2;
    const double kappa = curved(x, z, s + ds / 2);
    const double part = kappa > 0 ? std::min(theta / (kappa * ds), 1.0) : 1.0;
    out.across += std::cos(half_theta) * ds * part, out.drop += std::sin(half_theta) * ds * part;
    theta -= kappa * ds * part, s += ds * part;
    if (part < 1) break;
  }
  return out;
}

/// Secant search of a rising function, from a bracket that it widens.
double solve(const std::function<double(double)>& f, double guess) {
  double a = 0, b = std::max(guess, 1e-9), fa = f(a), fb = f(b);
  for (int i = 0; i < 60 && fb < 0; ++i) a = b, fa = fb, b *= 1.5, fb = f(b);
  for (int i = 0; i < 80 && b - a > 1e-10 * b; ++i) {
    double m = i % 3 == 2 ? (a + b) / 2 : a - fa * (b - a) / (fb - fa);
    m = std::clamp(m, a + 1e-3 * (b - a), b - 1e-3 * (b - a));
    const double fm = f(m);
    (fm < 0 ? a : b) = m, (fm < 0 ? fa : fb) = fm;
  }
  return (a + b) / 2;
}

class Machine {
 public:
  Machine(const Bench& b, const Pass& p, std::vector<Station>& memory)
      : b_(b), p_(p), memory_(memory), span_(p.span + b.span_more) {}

  /// The force at which the middle is pressed down by `to`.
  double at(double to, bool there) {
    const double friction = there ? b_.friction : -b_.friction;
    if (to <= 0) return 0;
    // The wire lies straight on the rollers where a set of the past holds it down: no force.
    HalfWire wire;
    const auto with_slope = [&](double slope) {
      const auto reaches = [&](double normal) {
        const HalfWire w = integrate(b_, span_, slope, normal, friction, memory_, nullptr);
        return span_ / 2 - b_.roller * std::sin(slope) - w.across;
      };
      // A larger reaction bends the wire level sooner, so it reaches less far.
      normal_ = solve(reaches, normal_);
      wire = integrate(b_, span_, slope, normal_, friction, memory_, nullptr);
      return b_.roller * (1 - std::cos(slope)) + wire.drop;
    };
    slope_ = solve([&](double slope) { return with_slope(slope) - to; }, std::max(3 * to / span_, 1e-6));
    with_slope(slope_);
    std::vector<Station> after = memory_;
    wire = integrate(b_, span_, slope_, normal_, friction, memory_, &after);
    memory_ = after;
    return wire.force;
  }

  Series run() {
    const auto turn = static_cast<std::size_t>(std::max_element(p_.displacement.begin(), p_.displacement.end()) -
                                               p_.displacement.begin());
    Series out;
    double dying = 0, before = 0, time = 0;
    for (std::size_t k = 0; k < p_.displacement.size(); ++k) {
      // The machine gives way by the force that it presses with.
      double to = p_.displacement[k] * share_there_, elastic = 0;
      for (int i = 0; i < 12; ++i) {
        const std::vector<Station> kept = memory_;
        elastic = at(to, k <= turn);
        const double off = to + b_.compliance * elastic - p_.displacement[k];
        if (std::fabs(off) < 1e-9) break;
        memory_ = kept;
        to -= off / (1 + b_.compliance * elastic / to);
      }
      share_there_ = to / p_.displacement[k];
      dying = dying * std::exp(-(p_.time_s[k] - time) / b_.relaxation_s) + elastic - before;
      before = elastic, time = p_.time_s[k];
      const double force = (1 - b_.relaxing) * elastic + b_.relaxing * dying;
      out.push_back(force + b_.zero + b_.drift_per_s * (p_.start_s + p_.time_s[k]));
    }
    return out;
  }

 private:
  const Bench& b_;
  const Pass& p_;
  std::vector<Station>& memory_;
  double span_, slope_ = 0, normal_ = 0.01;
  double share_there_ = 1;  ///< of the displacement that reaches the wire
};

std::vector<Series> measure(const Bench& b, const std::vector<Pass>& passes) {
  std::map<double, std::vector<Station>> memory;
  std::vector<Series> out;
  for (const Pass& p : passes) {
    std::vector<Station>& stations_there = memory[p.from_tip];
    if (stations_there.empty()) stations_there.resize(stations);
    out.push_back(Machine(b, p, stations_there).run());
  }
  return out;
}

/// Two places, three spans, small and large displacements, fast and slow; the last two repeat a span.
std::vector<Pass> design(Dice& dice) {
  std::vector<Pass> out;
  const double spans[] = {20, 20, 30, 30, 40, 40, 30, 30};
  const bool large[] = {false, true, false, true, false, true, true, false};
  const double place = dice.uniform(500, 700), rate = dice.uniform(0.03, 0.06);
  double start = 0;
  for (int r = 0; r < 8; ++r) {
    Pass p;
    p.span = spans[r], p.from_tip = place + 60 * (r % 2), p.start_s = start;
    const double most = p.span * (large[r] ? 0.1 : 0.045) * dice.uniform(0.9, 1.1), speed = rate * (r % 3 == 2 ? 4 : 1);
    const int half = 30;
    for (int k = 1; k < 2 * half; ++k) {
      p.displacement.push_back(most * (k <= half ? k : 2 * half - k) / half);
      p.time_s.push_back(most / half / speed * k);
    }
    start += p.time_s.back() + 30;
    out.push_back(p);
  }
  return out;
}

/// `amount`: 0 is nothing, 1 as much as a bench may have.
void switch_on(const std::string& content, double amount, Dice& dice, Bench& b) {
  const double u = dice.uniform(0, 1), side = dice.sign();
  if (content == "support_friction") b.friction = 0.5 * amount;
  if (content == "machine_compliance") b.compliance = 2 * amount;
  if (content == "span_error") b.span_more = 3 * side * amount;
  if (content == "zero_offset") b.zero = 0.1 * side * amount;
  if (content == "force_drift") b.drift_per_s = 2e-4 * side * amount;
  if (content == "relaxation") b.relaxing = 0.5 * amount, b.relaxation_s = 8 + 30 * u;
  if (content == "coil_core_slip") b.slider = 0.6 * amount, b.slips_at = 0.002 + 0.003 * u, b.EI /= 1 - b.slider;
  if (content == "plastic_set") b.slider = 0.9 * amount, b.slips_at = 0.018 + 0.006 * u;
  if (content == "superelastic_flag")
    b.flag_at = 0.016 + 0.006 * u, b.flag_back = 0.6 + 0.2 * u, b.flag_ratio = 1 - 0.9 * amount;
}

double excess(const std::vector<Series>& with, const std::vector<Series>& without, const std::vector<Series>& sigma) {
  double ww = 0, wo = 0, count = 0;
  for (std::size_t r = 0; r < with.size(); ++r)
    for (std::size_t k = 0; k < with[r].size(); ++k) {
      const double s2 = sigma[r][k] * sigma[r][k];
      ww += without[r][k] * without[r][k] / s2, wo += with[r][k] * without[r][k] / s2, ++count;
    }
  double left = 0;
  for (std::size_t r = 0; r < with.size(); ++r)
    for (std::size_t k = 0; k < with[r].size(); ++k)
      left += std::pow((with[r][k] - wo / ww * without[r][k]) / sigma[r][k], 2);
  return std::sqrt(left / count);
}

BenchSet make_of(const BenchWire* wire, const std::string& content, double size, unsigned seed) {
  Dice dice("bend:" + content, seed);
  Bench plain;
  double declared_EI = dice.log_uniform(20, 80);
  plain.EI = declared_EI * dice.log_uniform(0.75, 1.33), plain.roller = dice.uniform(1, 3);
  if (wire) declared_EI = wire->declared_EI, plain.EI = wire->EI;
  const std::vector<Pass> passes = design(dice);
  const std::vector<Series> without = measure(plain, passes);
  const double force_noise = 0.003 * declared_EI / 40 * dice.log_uniform(0.5, 1.5), displacement_noise = 0.002;
  std::vector<Series> sigma;
  for (std::size_t r = 0; r < passes.size(); ++r)
    sigma.emplace_back(without[r].size(),
                       std::hypot(force_noise, displacement_noise * 48 * plain.EI / std::pow(passes[r].span, 3)));
  std::vector<Series> force = without;
  BenchSet out;
  const bool noise_or_fault = content.find(':') != std::string::npos;
  if (content.starts_with("law:")) {  // as strong as it comes, whatever `size` says
    Bench b = plain;
    b.law = BendLaw(content, dice);
    force = measure(b, passes), out.effects = {b.law.id()};
    out.law = [b, declared_EI](double k_per_mm) { return b.EI / declared_EI * b.law.secant(k_per_mm); };
  }
  if (content != "clean" && !noise_or_fault) {
    const Dice at = dice;
    const auto with = [&](double amount) {
      Dice same = at;
      Bench b = plain;
      switch_on(content, amount, same, b);
      return measure(b, passes);
    };
    double low = 0, high = 1;
    for (int i = 0; i < 12; ++i) {
      const double middle = (low + high) / 2;
      (excess(with(middle), without, sigma) < size ? low : high) = middle;
    }
    force = with((low + high) / 2), out.effects = {content};
  }
  Json runs = Json::array();
  NoiseMaker noise(content, dice);
  for (std::size_t r = 0; r < passes.size(); ++r) {
    const Pass& p = passes[r];
    const Series on_force = noise.run(force[r].size()), on_displacement = noise.independent(force[r].size());
    Series seen = p.displacement, measured = force[r];
    for (std::size_t k = 0; k < seen.size(); ++k)
      seen[k] += displacement_noise * on_displacement[k], measured[k] += force_noise * on_force[k];
    runs.push_back({{"id", "b" + std::to_string(r)},
                    {"span_mm", p.span},
                    {"roller_radius_mm", plain.roller},
                    {"from_tip_mm", p.from_tip},
                    {"start_s", p.start_s},
                    {"time_s", p.time_s},
                    {"displacement_mm", seen},
                    {"force_N", measured}});
  }
  if (content.rfind("fault:", 0) == 0) {
    const auto r = static_cast<std::size_t>(dice.whole(0, 7));
    const auto scaled = [&](const char* key, double factor) {
      for (Json& v : runs[r][key]) v = v.get<double>() * factor;
    };
    out.effects = {"unit_error"};
    if (content == "fault:gram_force") scaled("force_N", 1 / 9.80665e-3);
    if (content == "fault:inches") scaled("displacement_mm", 1 / 25.4);
    if (content == "fault:swapped") {
      const std::size_t other = (r + 1 + 2 * static_cast<std::size_t>(dice.whole(0, 2))) % 8;
      for (const char* key : {"time_s", "displacement_mm", "force_N"}) std::swap(runs[r][key], runs[other][key]);
      out.effects = {"swapped_experiments"};
    }
    if (content == "fault:outlier")
      scaled("force_N", dice.uniform(0, 1) < 0.5 ? 0.8 : 1.25), out.effects = {"outlier_experiment"};
  }
  const Json file = {
      {"schema", "ostium-measurement/2"},
      {"kind", "three_point_bend"},
      {"title", "three-point bending"},
      {"instruments",
       {{{"name", "0.014in wire"},
         {"outer_radius_mm", 0.178},
         {"sections",
          {{{"from_tip_mm", {wire ? 0 : 300, 1500}}, {"EI_Nmm2", declared_EI}, {"GJ_Nmm2", 0.77 * declared_EI}}}}}}},
      {"rig", {{"friction", 0.0}, {"machine_stiffness_N_per_mm", nullptr}}},
      {"noise",
       {{"force_N", force_noise * noise.declared_share()},
        {"displacement_mm", displacement_noise * noise.declared_share()}}},
      {"runs", runs}};
  out.json = file.dump();
  return out;
}

BenchSet make(const std::string& content, double size, unsigned seed) { return make_of(nullptr, content, size, seed); }

}  // namespace

BenchSet bend_of(const BenchWire& wire, unsigned seed) { return make_of(&wire, "clean", 0, seed); }

BenchKind bend_kind() {
  return {"three_point_bend",
          {"clean",          "noise:shared",     "noise:heavy",       "noise:twice",   "support_friction",
           "coil_core_slip", "plastic_set",      "superelastic_flag", "relaxation",    "machine_compliance",
           "span_error",     "zero_offset",      "force_drift",       "law:two_stage", "law:locking",
           "law:stiffening", "law:many_sliders", "fault:gram_force",  "fault:inches",  "fault:swapped",
           "fault:outlier"},
          make};
}

}  // namespace ostium::synthetic
