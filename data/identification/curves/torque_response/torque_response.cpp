#include "data/identification/curves/torque_response/torque_response.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "data/identification/curves/set/instrument_keys.h"

namespace ostium::data::torque_response {

namespace {

using Eigen::VectorXd;
using units::degree, units::mm;

const curves::InstrumentKeys instrument_keys({.length = true, .no_gaps = true, .torsion = true});

const JsonObjectKeys set_keys = {
    "torque_response",
    curves::with_common_keys(
        "torque_response",
        {instrument_keys.in_set(),
         {"rig", true, "what is known of the path's walls, an object", json_type::object("torque_rig")},
         {"noise", true, "standard deviations, an object", json_type::object("torque_noise")},
         {"runs", true, curves::one_or_more, json_type::list_of(json_type::object("torque_run"), 1)}})};

const JsonObjectKeys rig_keys = {
    "torque_rig",
    {{"friction", true, "the coefficient of friction at the contacts, 0 to 2", json_type::number(from_to(0, 2))},
     {"lumen_clearance_mm", false, "between wire and wall in mm, >= 0", json_type::number(from_zero)}}};

const JsonObjectKeys noise_keys = {
    "torque_noise",
    {{"distal_deg", true, "of the distal angle in degrees, > 0, or null if it is unknown",
      json_type::null_or(json_type::number(above_zero))},
     {"torque_Nmm", true, "of the torque in N mm, > 0, or null if it is unknown",
      json_type::null_or(json_type::number(above_zero))}}};

const JsonObjectKeys run_keys = curves::run_keys(
    "torque_run",
    {{"path", false, "what the path is called, a text", json_type::text()},
     {"bends", true, "bends of the path, a list", json_type::list_of(json_type::object("torque_bend"))},
     {"contacts", true, "where the wire presses on the wall, a list",
      json_type::list_of(json_type::object("torque_contact"))}},
    {{"proximal_deg", true, "angle of the drive in degrees, one a sample", json_type::list_of(json_type::number(), 4)},
     {"distal_deg", true, "angle of the distal end in degrees, one a sample",
      json_type::list_of(json_type::number(), 4)},
     {"torque_Nmm", true, "at the drive in N mm, one a sample", json_type::list_of(json_type::number(), 4)}});

const JsonObjectKeys bend_keys = {
    "torque_bend",
    {{"at_mm", true, "where it begins, from the drive in mm, >= 0", json_type::number(from_zero)},
     {"radius_mm", true, "of the path's axis in mm, > 0 and at most 100000, at least the instrument's",
      json_type::number(above_zero_to(100000))},
     {"length_mm", true, "of its arc in mm, > 0", json_type::number(above_zero)},
     {"plane_deg", false, "how far its plane is turned about the wire in degrees, 0 if not given",
      json_type::number()}}};

const JsonObjectKeys contact_keys = {
    "torque_contact",
    {{"at_mm", true, "from the drive in mm, > 0", json_type::number(above_zero)},
     {"contact_force_N", true, "with which the wire presses on the wall in N, >= 0", json_type::number(from_zero)}}};

/// Returns its length in mm.
double read_instrument(const JsonObject& root, Setup& setup) {
  const curves::Instrument instrument = instrument_keys.read(root);
  setup.radius_m = instrument.radius_m;
  for (const curves::InstrumentSection& s : instrument.sections)
    setup.sections.push_back({instrument.length_m - s.to_m, instrument.length_m - s.from_tip_m, s.GJ_N_m2, s.EI_N_m2});
  return instrument.length_m / mm;
}

void read_path(const JsonObject& entry, double length_mm, const Setup& setup, Turning& turning) {
  for (const JsonValue& item : entry.list("bends")) {
    const JsonObject bend(item, bend_keys);
    turning.bends.push_back({bend.not_negative("at_mm") * mm, bend.positive("length_mm") * mm,
                             bend.positive("radius_mm") * mm,
                             bend.has("plane_deg") ? bend.number("plane_deg") * degree : 0});
    if (turning.bends.back().radius_m < setup.radius_m)
      bend["radius_mm"].refuse(fmt::format("at least the instrument's radius, {:g} mm", setup.radius_m / mm));
    const double end_mm = (turning.bends.back().at_m + turning.bends.back().length_m) / mm;
    if (end_mm > length_mm + 1e-6)
      bend["length_mm"].refuse(fmt::format("a bend that ends within the instrument's {:g} mm", length_mm));
  }
  double before_mm = 0;
  for (const JsonValue& item : entry.list("contacts")) {
    const JsonObject contact(item, contact_keys);
    const double at_mm = contact.positive("at_mm");
    if (at_mm < before_mm || at_mm > length_mm)
      contact["at_mm"].refuse(
          fmt::format("contacts in order from the drive, within the {:g} mm of the instrument", length_mm));
    turning.contacts.push_back({at_mm * mm, contact.not_negative("contact_force_N")}), before_mm = at_mm;
  }
}

VectorXd sigma_of(const JsonObject& noise, const std::string& key, Eigen::Index samples) {
  const std::optional<double> sigma = noise.number_or_null(key);
  return sigma ? VectorXd(VectorXd::Constant(samples, *sigma)) : VectorXd();
}

/// An angle that leaps by more than half a turn against the way in which the other one goes begins anew at a full turn.
void suspect_wrapped(const JsonObject& entry, const char* key, const VectorXd& angle_deg, const VectorXd& other_deg) {
  for (Eigen::Index k = 1; k < angle_deg.size(); ++k) {
    const double by = angle_deg[k] - angle_deg[k - 1], other = other_deg[k] - other_deg[k - 1];
    if (by * other < 0 && std::fabs(by) > 180 && std::fabs(other) < 180)
      entry[key].refuse(
          fmt::format("angles that go on beyond a turn; from {:g} to {:g} they leap back, so they look as if they "
                      "began anew at 180 or 360",
                      angle_deg[k - 1], angle_deg[k]));
  }
}

curves::Run read_run(const JsonValue& value, const JsonObject& noise, double length_mm, Setup& setup,
                     const std::vector<curves::Run>& others) {
  const JsonObject entry(value, run_keys);
  curves::Run run = curves::begin_run(entry, others);
  Turning turning;
  read_path(entry, length_mm, setup, turning);
  run.along = curves::read_samples(entry, "proximal_deg");
  turning.proximal_rad = run.along * degree;
  curves::Channel distal{"distal_deg", "distal angle", "deg", {}, {}}, torque{"torque_Nmm", "torque", "N mm", {}, {}};
  distal.measured = curves::read_samples_like(entry, "distal_deg", run.along, "proximal_deg");
  torque.measured = curves::read_samples_like(entry, "torque_Nmm", run.along, "proximal_deg");
  suspect_wrapped(entry, "distal_deg", distal.measured, run.along);
  suspect_wrapped(entry, "proximal_deg", run.along, distal.measured);
  distal.sigma = sigma_of(noise, "distal_deg", run.samples());
  torque.sigma = sigma_of(noise, "torque_Nmm", run.samples());
  run.along_label = "proximal angle", run.along_unit = "deg";
  run.channels = {distal, torque};
  setup.runs.push_back(turning);
  return run;
}

constexpr double stretch = 4, share = 0.5;  // of the lag (torque_response.h)

/// Widens what is known of samples just after the drive turned back.
void widen(const Setup& setup, std::vector<curves::Run>& runs) {
  const std::vector<curves::Curves> expected = responses(setup);
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const VectorXd& turned = runs[r].along;
    double side = 0, lag = 0, torque = 0;
    Eigen::Index turn = 0;
    for (Eigen::Index k = 1; k < turned.size(); ++k) {
      const double by = turned[k] - turned[k - 1];
      if (by * side < 0) {
        turn = k - 1;
        lag = std::fabs(turned[turn] - expected[r][0][turn]), torque = std::fabs(expected[r][1][turn]);
      }
      if (by != 0) side = by > 0 ? 1 : -1;
      if (lag == 0 || std::fabs(turned[k] - turned[turn]) > stretch * lag) continue;
      const double wide[] = {share * lag, share * torque};
      for (std::size_t c = 0; c < 2; ++c)
        if (VectorXd& sigma = runs[r].channels[c].sigma; sigma.size() > 0) sigma[k] = std::hypot(sigma[k], wide[c]);
    }
  }
}

/// A few radians are no turn that anybody measures.
void suspect_radians(const JsonObject& root, const std::vector<curves::Run>& runs) {
  constexpr double least_deg = 15;
  for (const curves::Run& run : runs)
    if (run.along.cwiseAbs().maxCoeff() >= least_deg) return;
  root.list("runs")[0]
      .find("proximal_deg")
      ->refuse(fmt::format("degrees; no run turns by {:g}, so these look like radians or turns", least_deg));
}

/// Sections that twist in some run.
std::vector<bool> twisted(const Setup& setup) {
  std::vector<bool> out(setup.sections.size(), false);
  for (const Turning& run : setup.runs)
    for (std::size_t i = 0; i < out.size() && !run.contacts.empty(); ++i)
      if (setup.sections[i].from_m < run.contacts.back().at_m) out[i] = true;
  return out;
}

void set_free(std::span<const double> free, Setup& setup) {
  const std::vector<bool> has = twisted(setup);
  for (std::size_t i = 0, k = 0; i < has.size(); ++i)
    if (has[i]) setup.sections[i].GJ_N_m2 *= free[k++];
}

std::vector<EffectParameter> free_numbers(const Setup& setup) {
  const std::vector<bool> has = twisted(setup);
  std::vector<EffectParameter> out;
  for (std::size_t i = 0; i < has.size(); ++i)
    if (has[i])
      out.push_back({fmt::format("GJ_scale[{}]", i), "1",
                     fmt::format("torsional stiffness of section {} against that declared", i), 1, 0.3, 0.1, 10, true});
  return out;
}

std::unique_ptr<curves::Set> read(const JsonValue& file) {
  const JsonObject root(file, set_keys), rig(root["rig"], rig_keys), noise(root["noise"], noise_keys);
  Setup setup;
  const double length_mm = read_instrument(root, setup);
  setup.friction = rig.not_negative("friction");
  std::vector<curves::Run> runs;
  for (const JsonValue& value : root.list("runs")) runs.push_back(read_run(value, noise, length_mm, setup, runs));
  if (runs.empty()) root.refuse("runs");
  suspect_radians(root, runs);
  widen(setup, runs);
  std::vector<Effect> effects = {wall_friction(), whip(), handed_stiffness(), drive_slip(), drive_backlash()};
  for (std::size_t r = 1; r < runs.size(); ++r) effects.push_back(reseated_instrument(r, runs[r].id));
  const std::vector<EffectParameter> free = free_numbers(setup);
  auto set = std::make_unique<curves::SetOf<Setup>>(setup, runs, free, set_free, responses, effects);
  curves::declare(root, *set);
  return set;
}

}  // namespace

curves::Kind kind() {
  return {"torque_response", "angle of the distal end and torque against the angle of the drive, in a path", read,
          instrument_keys.with(
              {&set_keys, &rig_keys, &noise_keys, &run_keys, &bend_keys, &contact_keys, &curves::effect_keys})};
}

}  // namespace ostium::data::torque_response
