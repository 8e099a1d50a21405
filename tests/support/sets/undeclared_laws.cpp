#include "tests/support/sets/undeclared_laws.h"

#include <algorithm>
#include <cmath>

namespace ostium::synthetic {

namespace {

using units::mm, units::pi;

using Along = std::function<double(double)>;  ///< of the distance from the tip, m

double longest_m(const data::MeasurementSet& set) {
  double out = 0;
  for (const data::Experiment& e : set.experiments) out = std::max(out, e.set.back().inserted_m);
  return out;
}

Along two_bumps(Dice& dice, double longest) {
  const double a = dice.either(0.35, 0.8), at = dice.uniform(0.2, 0.42) * longest, b = dice.either(0.35, 0.8),
               then = dice.uniform(0.58, 0.8) * longest, wide = dice.uniform(0.07, 0.13) * longest;
  return [=](double s) {
    const double u = (s - at) / wide, v = (s - then) / wide;
    return a * std::exp(-u * u) + b * std::exp(-v * v);
  };
}

Along wave(Dice& dice, double longest) {
  const double a = dice.uniform(0.3, 0.6), length = dice.uniform(0.4, 0.75) * longest, phase = dice.uniform(0, 2 * pi);
  return [=](double s) { return a * std::sin(2 * pi * s / length + phase); };
}

/// Rises over a length, and falls within a fifth of that.
Along saw(Dice& dice, double longest) {
  const double a = dice.either(0.35, 0.7), length = dice.uniform(0.4, 0.6) * longest, from = dice.uniform(0, 1);
  return [=](double s) {
    const double t = std::fmod(s / length + from, 1.0);
    return a * (t < 5.0 / 6 ? 2 * t / (5.0 / 6) - 1 : 1 - 2 * (t - 5.0 / 6) * 6);
  };
}

/// The same stiffness of finely cut sections.
std::vector<core::Section> scaled(const std::vector<core::Section>& sections, double to_m, const Along& log_factor) {
  constexpr double piece_m = 4e-3;
  std::vector<core::Section> out;
  for (const core::Section& s : sections) {
    const int count = std::max(1, static_cast<int>(std::ceil((std::min(s.to_tip_m, to_m) - s.from_tip_m) / piece_m)));
    const double end = std::min(s.to_tip_m, std::max(to_m, s.from_tip_m + piece_m)),
                 cell = (end - s.from_tip_m) / count;
    for (int i = 0; i <= count; ++i) {
      core::Section c = s;
      c.from_tip_m = s.from_tip_m + i * cell;
      c.to_tip_m = i < count ? c.from_tip_m + cell : s.to_tip_m;
      if (c.to_tip_m - c.from_tip_m < 1e-9) continue;
      const double factor = std::exp(log_factor(std::min((c.from_tip_m + c.to_tip_m) / 2, to_m)));
      c.EI1_N_m2 *= factor, c.EI2_N_m2 *= factor, c.GJ_N_m2 *= factor;
      out.push_back(c);
    }
  }
  return out;
}

/// Moment over EI against curvature, 1/m, by its tangent.
struct Bending {
  std::vector<double> moment = {0};
  static constexpr double step = 0.005;

  explicit Bending(const std::function<double(double)>& tangent) {
    for (double k = 0; k < 60; k += step) moment.push_back(moment.back() + step * tangent(k + step / 2));
  }
  double moment_at(double k) const {
    const auto i = std::min(static_cast<std::size_t>(k / step), moment.size() - 2);
    return moment[i] + (moment[i + 1] - moment[i]) * (k / step - static_cast<double>(i));
  }
  double curvature_at(double m) const {
    const auto i = static_cast<std::size_t>(std::upper_bound(moment.begin() + 1, moment.end() - 1, m) - moment.begin());
    return step * (static_cast<double>(i - 1) + (m - moment[i - 1]) / (moment[i] - moment[i - 1]));
  }
};

std::function<double(double)> tangent_of(const std::string& id, Dice& dice) {
  const auto rise = [](double k, double at, double over) { return 1 / (1 + std::exp(-(k - at) / over)); };
  const double a = dice.uniform(0.25, 0.45), b = dice.uniform(0.25, 0.45), at = dice.log_uniform(0.5, 0.9),
               then = at * dice.uniform(2.2, 3.2), over = dice.uniform(0.12, 0.25);
  if (id == "law:two_stage")
    return [=](double k) { return 1 - a * rise(k, at, over * at) - b * rise(k, then, over * then); };
  if (id == "law:locking")
    return [=](double k) { return 1 - 1.6 * a * rise(k, at, over * at) + b * rise(k, then, over * then); };
  if (id == "law:stiffening") return [=](double k) { return 1 + 2 * a * rise(k, at, over * then); };
  return {};
}

}  // namespace

bool add_law(const std::string& id, Dice& dice, const Truth& truth, Undeclared& made, World& world) {
  const double longest = longest_m(made.set);
  if (const auto tangent = tangent_of(id, dice)) {
    const Bending bending(tangent);
    world.mechanics.push_back([=](const data::Experiment&, boundary_value::Problem& p) {
      p.tubes[0].more_curved = [=](double linear) { return linear > 0 ? bending.curvature_at(linear) / linear : 1; };
    });
    const double scale = truth.stiffness_scale[0].back();
    made.effects = {"law:bending"};
    made.law = [=](double k_per_mm) { return scale * bending.moment_at(k_per_mm / mm) * mm / k_per_mm; };
    return true;
  }
  Along log_factor;
  if (id == "law:two_bumps") log_factor = two_bumps(dice, longest);
  if (id == "law:wave") log_factor = wave(dice, longest);
  if (id == "law:saw") log_factor = saw(dice, longest);
  if (!log_factor) return false;
  world.mechanics.push_back([=](const data::Experiment&, boundary_value::Problem& p) {
    p.tubes[0].sections = scaled(p.tubes[0].sections, longest, log_factor);
  });
  const std::vector<core::Section> sections = made.set.instruments[0].sections;
  made.effects = {"law:stiffness"};
  made.law = [=](double from_tip_mm) {
    std::size_t in = 0;
    while (in + 1 < sections.size() && sections[in].to_tip_m <= from_tip_mm * mm) ++in;
    return truth.stiffness_scale[0][in] * std::exp(log_factor(from_tip_mm * mm));
  };
  return true;
}

std::vector<std::string> with_laws(std::vector<std::string> kinds) {
  for (const char* id : {"law:two_bumps", "law:wave", "law:saw", "law:two_stage", "law:locking", "law:stiffening"})
    kinds.emplace_back(id);
  return kinds;
}

}  // namespace ostium::synthetic
