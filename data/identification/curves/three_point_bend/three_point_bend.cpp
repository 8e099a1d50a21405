#include "data/identification/curves/three_point_bend/three_point_bend.h"

#include <fmt/format.h>

#include <array>
#include <map>

#include "core/base/units.h"
#include "data/identification/curves/set/instrument_keys.h"

namespace ostium::data::three_point_bend {

namespace {

using Eigen::VectorXd;
using units::mm;

/// Force over EI against deflection, for one span, roller and friction, as far as `most_m`.
class Elastica {
 public:
  Elastica(double span_m, double roller_m, double friction, double most_m) {
    const double phi = std::atan(friction);
    constexpr int count = 48;
    // The angle at the rollers, about 3 deflections a span; no bench bends a wire further than 1.1.
    const double most = std::min(5 * most_m / span_m + 0.02, 1.1);
    for (int k = 1; k <= count; ++k) {
      const double theta = most * k / count, turn = phi + theta, U = std::sqrt(std::sin(turn) - std::sin(phi));
      if (!(U > 0)) break;
      const double X = std::sqrt(2.0) * U, Y = across(phi, U) / std::sqrt(2.0);
      // The axis of the elastica is turned by phi + theta from the level tangent in the middle.
      const double c = std::cos(turn), s = std::sin(turn), level = X * c + Y * s, down = X * s - Y * c;
      const double size = (span_m / 2 - roller_m * std::sin(theta)) / level;  // sqrt(EI / N)
      if (!(size > 0)) break;
      const double to = roller_m * (1 - std::cos(theta)) + size * down;
      if (to <= (deflection_m.empty() ? 0 : deflection_m.back())) continue;
      deflection_m.push_back(to);
      stiffness_per_m3.push_back(2 * c / (size * size) / to);
    }
  }
  /// Interpolated in force over deflection, which changes little.
  double at(double deflection) const {
    if (deflection <= 0 || deflection_m.empty()) return 0;
    if (deflection_m.size() == 1) return deflection * stiffness_per_m3[0];
    const auto above = std::upper_bound(deflection_m.begin(), deflection_m.end() - 1, deflection);
    const auto i = std::max<std::ptrdiff_t>(above - deflection_m.begin(), 1);
    const double part = (deflection - deflection_m[i - 1]) / (deflection_m[i] - deflection_m[i - 1]);
    return deflection * (stiffness_per_m3[i - 1] + part * (stiffness_per_m3[i] - stiffness_per_m3[i - 1]));
  }

 private:
  /// Integral of sin psi / sqrt(sin psi - sin phi) = 2 tan psi du, with sin psi = sin phi + u^2, by Gauss's rule.
  static double across(double phi, double U) {
    constexpr std::array<double, 4> x = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                         0.9602898564975363};
    constexpr std::array<double, 4> w = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                         0.1012285362903763};
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i)
      for (const double side : {-1.0, 1.0}) {
        const double u = U * (1 + side * x[i]) / 2, s = std::sin(phi) + u * u;
        sum += w[i] * 2 * s / std::sqrt(1 - s * s);
      }
    return sum * U / 2;
  }

  std::vector<double> deflection_m, stiffness_per_m3;
};

constexpr std::size_t stations = 8;
using States = std::array<SectionState, stations>;

/// Deflection of a beam of small slope under `force_per_m2` = F / EI, and what its sections then remember.
double deflection(const SectionLaw& law, double span_m, double force_per_m2, const States& before, States* after) {
  double sum = 0;
  const double cell = span_m / 2 / stations;
  for (std::size_t k = 0; k < stations; ++k) {
    const double x = (static_cast<double>(k) + 0.5) * cell, moment = force_per_m2 * x / 2;
    const SectionState state = before[k].after(law, moment);
    // Over a cell x^2 has more than at its middle.
    sum += (moment / x * (x * x + cell * cell / 12) + state.extra_per_m(law, moment) * x) * cell;
    if (after) (*after)[k] = state;
  }
  return sum;
}

/// The force that a beam of small slope needs for a deflection, over EI.
double force_for(const SectionLaw& law, double span_m, double to_m, States& states) {
  double low = 0, high = 1.5 * 48 / (span_m * span_m * span_m) * to_m;
  if (deflection(law, span_m, 0, states, nullptr) >= to_m) {  // it has lifted off
    deflection(law, span_m, 0, States(states), &states);
    return 0;
  }
  // Secants within the bracket (regula falsi; Illinois), as the deflection rises with the force.
  double at_low = deflection(law, span_m, low, states, nullptr) - to_m,
         at_high = deflection(law, span_m, high, states, nullptr) - to_m;
  double force = low;
  for (int i = 0, side = 0; i < 50; ++i) {
    force = (low * at_high - high * at_low) / (at_high - at_low);
    const double off = deflection(law, span_m, force, states, nullptr) - to_m;
    if (std::fabs(off) < 1e-9 * to_m) break;
    if (off < 0) {
      low = force, at_low = off;
      if (side < 0) at_high /= 2;
      side = -1;
    } else {
      high = force, at_high = off;
      if (side > 0) at_low /= 2;
      side = 1;
    }
  }
  deflection(law, span_m, force, States(states), &states);
  return force;
}

double stiffness_of(const Setup& setup, const Pass& pass) {
  double compliance = 0;
  for (const auto& [section, share] : pass.share) compliance += share / setup.EI_N_m2[section];
  return 1 / compliance;
}

/// A pass's forces, without drift and zero.
class Passage {
 public:
  Passage(const Setup& setup, const Pass& pass, States& states)
      : setup_(setup),
        pass_(pass),
        states_(states),
        span_m_(pass.span_m + setup.span_more_m),
        EI_(stiffness_of(setup, pass)),
        there_(span_m_, pass.roller_m, -setup.friction, pass.displacement_m.maxCoeff()),
        back_(span_m_, pass.roller_m, setup.friction, pass.displacement_m.maxCoeff()) {}

  VectorXd run() {
    const VectorXd& x = pass_.displacement_m;
    VectorXd out(x.size());
    Eigen::Index turn = 0;
    x.maxCoeff(&turn);
    double slow = 0, before = 0;
    for (Eigen::Index k = 0; k < x.size(); ++k) {
      const double elastic = force_at(x[k], k <= turn);
      // Of the share that relaxes, what is still there follows the force's changes and dies away.
      const double dt = k > 0 ? pass_.time_s[k] - pass_.time_s[k - 1] : 0;
      slow = slow * std::exp(-std::max(dt, 0.0) / setup_.relaxation_s) + elastic - before;
      before = elastic;
      out[k] = (1 - setup_.relaxing) * elastic + setup_.relaxing * slow;
    }
    return out;
  }

 private:
  double force_at(double displacement, bool there) {
    // The machine gives way by what it presses with.
    double force = 0, to = displacement;
    const Elastica& curve = there ? there_ : back_;
    for (int i = 0; i < 30; ++i) {
      const double stiff = EI_ * 48 / (span_m_ * span_m_ * span_m_), next = EI_ * curve.at(to);
      const double off = displacement - setup_.machine_m_per_N * next - to;
      force = next;
      if (std::fabs(off) < 1e-12) break;
      to += off / (1 + setup_.machine_m_per_N * stiff);
    }
    if (setup_.section.linear() || to <= 0) return force;
    const double linear = 48 * to / (span_m_ * span_m_ * span_m_);
    return force * force_for(setup_.section, span_m_, to, states_) / linear;
  }

  const Setup& setup_;
  const Pass& pass_;
  States& states_;
  double span_m_, EI_;
  Elastica there_, back_;
};

}  // namespace

double largest_curvature_per_m(const Setup& setup) {
  double out = 0;
  for (const Pass& pass : setup.passes)
    out = std::max(out, 12 * pass.displacement_m.maxCoeff() / (pass.span_m * pass.span_m));
  return out;
}

std::vector<curves::Curves> forces(const Setup& setup) {
  std::map<long, States> remembered;  // by place, um from the tip: a set stays where the wire was bent
  std::vector<curves::Curves> out;
  for (const Pass& pass : setup.passes) {
    States& states = remembered[std::lround(pass.from_tip_m * 1e6)];
    VectorXd F = Passage(setup, pass, states).run();
    for (Eigen::Index k = 0; k < F.size(); ++k) F[k] += setup.zero_N + setup.drift_N_per_s * pass.time_s[k];
    out.push_back({F});
  }
  return out;
}

namespace {

const curves::InstrumentKeys instrument_keys({});

const JsonObjectKeys set_keys = {
    "three_point_bend",
    curves::with_common_keys(
        "three_point_bend",
        {instrument_keys.in_set(),
         {"rig", true, "what is known of the machine, an object", json_type::object("bend_rig")},
         {"noise", true, "standard deviations, an object", json_type::object("bend_noise")},
         {"runs", true, curves::one_or_more, json_type::list_of(json_type::object("bend_run"), 1)}})};

const JsonObjectKeys rig_keys = {
    "bend_rig",
    {{"friction", true, "the coefficient of friction at the rollers, 0 to 2", json_type::number(from_to(0, 2))},
     {"machine_stiffness_N_per_mm", true, "how stiff the machine is in N/mm, > 0, or null: rigid",
      json_type::null_or(json_type::number(above_zero))},
     {"temperature_C", false, "the temperature in degrees Celsius", json_type::number()}}};

const JsonObjectKeys noise_keys = {
    "bend_noise",
    {{"force_N", true, "of the force in N, > 0, or null if it is unknown",
      json_type::null_or(json_type::number(above_zero))},
     {"displacement_mm", true, "of the displacement in mm, >= 0, or null if it is unknown",
      json_type::null_or(json_type::number(from_zero))}}};

const JsonObjectKeys run_keys = curves::run_keys(
    "bend_run",
    {{"span_mm", true, "between the rollers' axes in mm, > 0", json_type::number(above_zero)},
     {"roller_radius_mm", true, "from a roller's axis to the wire's axis in mm, >= 0", json_type::number(from_zero)},
     {"from_tip_mm", true, "where it was pressed, from the distal tip in mm, >= 0", json_type::number(from_zero)},
     {"start_s", false, "when the run began in s, >= 0", json_type::number(from_zero)}},
    {{"time_s", true, "since the run began in s, rising, one a sample", json_type::list_of(json_type::number(), 4)},
     {"displacement_mm", true, "of the middle roller in mm, one a sample", json_type::list_of(json_type::number(), 4)},
     {"force_N", true, "on the middle roller in N, one a sample", json_type::list_of(json_type::number(), 4)}});

/// Weights of a pass's compliance, integral of moment squared: the middle counts most.
std::vector<std::pair<std::size_t, double>> shares(const JsonObject& entry, const Pass& pass,
                                                   const std::vector<curves::InstrumentSection>& sections) {
  std::vector<std::pair<std::size_t, double>> out;
  constexpr int cells = 200;
  for (int k = 0; k < cells; ++k) {
    const double u = (k + 0.5) / cells * 2 - 1, at = pass.from_tip_m + u * pass.span_m / 2;
    const double weight = 1.5 * (1 - std::fabs(u)) * (1 - std::fabs(u)) * 2 / cells;
    std::size_t in = 0;
    while (in < sections.size() && !(sections[in].from_tip_m <= at && at <= sections[in].to_m)) ++in;
    if (in == sections.size())
      entry["from_tip_mm"].refuse(fmt::format(
          "the span, {:g} mm on either side, to lie within sections of the instrument", pass.span_m / mm / 2));
    if (out.empty() || out.back().first != in) out.emplace_back(in, 0);
    out.back().second += weight;
  }
  return out;
}

curves::Run read_run(const JsonValue& value, const JsonObject& noise,
                     const std::vector<curves::InstrumentSection>& sections, Setup& setup,
                     const std::vector<curves::Run>& others) {
  const JsonObject entry(value, run_keys);
  curves::Run run = curves::begin_run(entry, others);
  Pass pass;
  pass.span_m = entry.positive("span_mm") * mm, pass.roller_m = entry.not_negative("roller_radius_mm") * mm;
  pass.from_tip_m = entry.not_negative("from_tip_mm") * mm;
  if (pass.roller_m >= pass.span_m / 4) entry.refuse("roller_radius_mm");
  pass.share = shares(entry, pass, sections);
  pass.displacement_m = curves::read_samples(entry, "displacement_mm") * mm;
  pass.time_s = curves::read_samples_like(entry, "time_s", pass.displacement_m, "displacement_mm");
  curves::must_rise(entry, "time_s", pass.time_s);
  if (entry.has("start_s")) pass.time_s.array() += entry.not_negative("start_s");
  curves::Channel force{"force_N", "force", "N", {}, {}};
  force.measured = curves::read_samples_like(entry, "force_N", pass.displacement_m, "displacement_mm");
  const auto force_N = noise.number_or_null("force_N"), displacement_mm = noise.number_or_null("displacement_mm");
  if (force_N && displacement_mm) {
    // Noise of the displacement is seen as one of the force, by the slope.
    const double slope = 48 * stiffness_of(setup, pass) / std::pow(pass.span_m, 3);
    force.sigma = VectorXd::Constant(force.measured.size(), std::hypot(*force_N, slope * *displacement_mm * mm));
  }
  run.along = pass.displacement_m / mm, run.along_label = "displacement", run.along_unit = "mm";
  run.channels = {force};
  setup.passes.push_back(pass);
  return run;
}

void set_free(std::span<const double> free, Setup& setup) {
  // Sections without a run have no number of their own and keep what is declared.
  std::vector<bool> bent(setup.EI_N_m2.size(), false);
  for (const Pass& pass : setup.passes)
    for (const auto& share : pass.share) bent[share.first] = true;
  for (std::size_t i = 0, k = 0; i < bent.size(); ++i)
    if (bent[i]) setup.EI_N_m2[i] *= free[k++];
}

std::vector<EffectParameter> free_numbers(const Setup& setup) {
  std::vector<bool> bent(setup.EI_N_m2.size(), false);
  for (const Pass& pass : setup.passes)
    for (const auto& share : pass.share) bent[share.first] = true;
  std::vector<EffectParameter> out;
  for (std::size_t i = 0; i < bent.size(); ++i)
    if (bent[i])
      out.push_back({fmt::format("EI_scale[{}]", i), "1",
                     fmt::format("bending stiffness of section {} against that declared", i), 1, 0.3, 0.1, 10, true});
  return out;
}

std::unique_ptr<curves::Set> read(const JsonValue& file) {
  const JsonObject root(file, set_keys), rig(root["rig"], rig_keys), noise(root["noise"], noise_keys);
  Setup setup;
  const curves::Instrument instrument = instrument_keys.read(root);
  setup.radius_m = instrument.radius_m;
  for (const curves::InstrumentSection& s : instrument.sections) setup.EI_N_m2.push_back(s.EI_N_m2);
  setup.friction = rig.not_negative("friction");
  if (const auto stiffness_N_per_mm = rig.number_or_null("machine_stiffness_N_per_mm"))
    setup.machine_m_per_N = mm / *stiffness_N_per_mm;
  std::vector<curves::Run> runs;
  for (const JsonValue& value : root.list("runs"))
    runs.push_back(read_run(value, noise, instrument.sections, setup, runs));
  if (runs.empty()) root.refuse("runs");
  const std::vector<EffectParameter> free = free_numbers(setup);
  auto set = std::make_unique<curves::SetOf<Setup>>(
      setup, runs, free, set_free, forces,
      std::vector<Effect>{support_friction(), coil_core_slip(), plastic_set(), superelastic_flag(), relaxation(),
                          machine_compliance(), span_error(), zero_offset(), force_drift(), law_bending(),
                          law_bending_hysteresis()});
  curves::declare(root, *set);
  return set;
}

}  // namespace

curves::Kind kind() {
  return {"three_point_bend", "force against displacement of a wire on two rollers, there and back", read,
          instrument_keys.with({&set_keys, &rig_keys, &noise_keys, &run_keys, &curves::effect_keys})};
}

}  // namespace ostium::data::three_point_bend
