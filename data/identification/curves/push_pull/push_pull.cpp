#include "data/identification/curves/push_pull/push_pull.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/units.h"

namespace ostium::data::push_pull {

namespace {

using Eigen::VectorXd;
using units::degree, units::mm;

const curves::InstrumentKeys instrument_keys({.no_gaps = true});

const JsonObjectKeys set_keys = {
    "push_pull",
    curves::with_common_keys(
        "push_pull", {instrument_keys.in_set(),
                      {"rig", true, "what is known of the path's walls, an object", json_type::object("push_rig")},
                      {"noise", true, "standard deviations, an object", json_type::object("push_noise")},
                      {"runs", true, curves::one_or_more, json_type::list_of(json_type::object("push_run"), 1)}})};

const JsonObjectKeys rig_keys = {"push_rig",
                                 {{"friction", true, "the coefficient of friction at the walls, > 0 and at most 2",
                                   json_type::number(above_zero_to(2))}}};

const JsonObjectKeys noise_keys = {
    "push_noise",
    {{"hand_force_N", true, "of the force at the hand in N, > 0, or null if it is unknown",
      json_type::null_or(json_type::number(above_zero))},
     {"tip_force_N", false, "of the force at the tip in N, >= 0, or null if it is unknown",
      json_type::null_or(json_type::number(from_zero))}}};

const JsonObjectKeys run_keys = curves::run_keys(
    "push_run",
    {{"path", true, "bends and bore, an object", json_type::object("push_path")},
     {"start_s", false, "when the run began in s, >= 0", json_type::number(from_zero)}},
    {{"time_s", false, "since the run began in s, one a sample", json_type::list_of(json_type::number(), 4)},
     {"inserted_mm", true, "from the path's entrance to the tip in mm, one a sample",
      json_type::list_of(json_type::number(), 4)},
     {"hand_force_N", true, "push of the hand in N, negative for a pull, one a sample",
      json_type::list_of(json_type::number(), 4)},
     {"tip_force_N", false, "push of the tip on what is before it in N, one a sample; 0 if not given",
      json_type::list_of(json_type::number(), 4)}});

const JsonObjectKeys path_keys = {
    "push_path",
    {{"name", false, "what it is called, a text", json_type::text()},
     {"bore_mm", true, "inner diameter of the tube in mm, wider than the instrument, at most 100",
      json_type::number(above_zero_to(100))},
     {"bends", true, "bends from the entrance on, a list", json_type::list_of(json_type::object("push_bend"))}}};

const JsonObjectKeys bend_keys = {
    "push_bend",
    {{"at_mm", true, "where it begins, from the entrance in mm, 0 to 10000, behind the bend before",
      json_type::number(from_to(0, 10000))},
     {"radius_mm", true, "of its axis in mm, > 0 and at most 100000, at least half the bore",
      json_type::number(above_zero_to(100000))},
     {"angle_deg", false, "by which it turns in degrees, > 0 and at most 3600; or length_mm",
      json_type::number(above_zero_to(3600))},
     {"length_mm", false, "of its arc in mm, > 0 and at most 10000; or angle_deg",
      json_type::number(above_zero_to(10000))}}};

void read_path(const JsonValue& value, double radius_m, Passage& passage) {
  const JsonObject path(value, path_keys);
  passage.bore_radius_m = path.positive("bore_mm") * mm / 2;
  if (passage.bore_radius_m <= radius_m)
    path["bore_mm"].refuse(fmt::format("a bore wider than the instrument, {:g} mm", 2 * radius_m / mm));
  for (const JsonValue& item : path.list("bends")) {
    const JsonObject entry(item, bend_keys);
    Bend bend{entry.not_negative("at_mm") * mm, entry.positive("radius_mm") * mm, 0};
    if (bend.radius_m < passage.bore_radius_m)
      entry["radius_mm"].refuse(fmt::format("at least half the bore, {:g} mm: a tube that bends more crosses itself",
                                            passage.bore_radius_m / mm));
    if (entry.has("angle_deg") == entry.has("length_mm"))
      entry.value().fail(entry.value().path() + ": expected either angle_deg or length_mm");
    bend.angle_rad = entry.has("angle_deg") ? entry.positive("angle_deg") * degree
                                            : entry.positive("length_mm") * mm / bend.radius_m;
    constexpr double least_deg = 7;
    if (entry.has("angle_deg") && bend.angle_rad < least_deg * degree)
      entry["angle_deg"].refuse(fmt::format("degrees, at least {:g}; less looks like radians", least_deg));
    if (!passage.bends.empty() && bend.at_m < passage.bends.back().end_m() - 1e-9) entry.refuse("at_mm");
    passage.bends.push_back(bend);
  }
}

/// In which direction each sample was reached; the first as the next one is.
VectorXd directions(const VectorXd& inserted) {
  VectorXd out(inserted.size());
  double side = 0;
  for (Eigen::Index k = 1; k < inserted.size() && side == 0; ++k)
    side = inserted[k] > inserted[k - 1] ? 1 : inserted[k] < inserted[k - 1] ? -1 : 0;
  if (side == 0) side = 1;
  for (Eigen::Index k = 0; k < inserted.size(); ++k) {
    if (k > 0 && inserted[k] != inserted[k - 1]) side = inserted[k] > inserted[k - 1] ? 1 : -1;
    out[k] = side;
  }
  return out;
}

/// Distance run in and out.
double travel_of(const VectorXd& inserted) {
  const Eigen::Index steps = inserted.size() - 1;
  return (inserted.tail(steps) - inserted.head(steps)).cwiseAbs().sum();
}

void read_times(const JsonObject& entry, Passage& passage) {
  if (!entry.has("time_s")) return;
  passage.time_s = curves::read_samples_like(entry, "time_s", passage.inserted_m, "inserted_mm");
  for (Eigen::Index k = 1; k < passage.time_s.size(); ++k)
    if (passage.time_s[k] < passage.time_s[k - 1]) {
      entry.list("time_s")[static_cast<std::size_t>(k)].refuse("a time not before that of the sample before");
    }
  if (entry.has("start_s")) passage.time_s.array() += entry.not_negative("start_s");
}

curves::Run read_run(const JsonValue& value, const JsonObject& noise, Setup& setup,
                     const std::vector<curves::Run>& others) {
  const JsonObject entry(value, run_keys);
  curves::Run run = curves::begin_run(entry, others);
  Passage passage;
  read_path(entry["path"], setup.radius_m, passage);
  run.along = curves::read_samples(entry, "inserted_mm");
  if (run.along.minCoeff() < 0) entry["inserted_mm"].refuse("lengths from 0 mm");
  passage.inserted_m = run.along * mm, passage.direction = directions(run.along);
  if (run.along.maxCoeff() * mm > setup.sections.back().to_m + 1e-9)
    entry["inserted_mm"].refuse(
        fmt::format("at most {:g} mm, as far as the instrument's sections go", setup.sections.back().to_m / mm));
  read_times(entry, passage);
  passage.tip_N = entry.has("tip_force_N") ? curves::read_samples_like(entry, "tip_force_N", run.along, "inserted_mm")
                                           : VectorXd::Zero(run.along.size());
  if (!setup.runs.empty()) {
    const Passage& before = setup.runs.back();
    passage.run_before_m = before.run_before_m + travel_of(before.inserted_m);
  }
  const std::size_t path = setup.walls->path(passage.bends, passage.bore_radius_m - setup.radius_m);
  passage.between_samples =
      travel_of(passage.inserted_m) < static_cast<double>(run.samples() - 1) * setup.walls->spacing_m(path) / 2;
  curves::Channel hand{"hand_force_N", "force at the hand", "N", {}, {}};
  hand.measured = curves::read_samples_like(entry, "hand_force_N", run.along, "inserted_mm");
  const auto hand_N = noise.number_or_null("hand_force_N"), tip_N = noise.number_or_null("tip_force_N");
  if (hand_N) {
    hand.sigma = VectorXd::Constant(run.samples(), *hand_N);
    for (Eigen::Index k = 0; k < run.samples() && tip_N && entry.has("tip_force_N"); ++k) {
      // The tip's noise reaches the hand through the bends.
      const double gain =
          std::exp(setup.friction * passage.direction[k] * turned(passage.bends, passage.inserted_m[k]));
      hand.sigma[k] = std::hypot(hand.sigma[k], gain * *tip_N);
    }
  }
  run.along_label = "inserted", run.along_unit = "mm";
  run.channels = {hand};
  setup.runs.push_back(passage);
  return run;
}

/// Sections that reach a bend in some run.
std::vector<bool> bent(const Setup& setup) {
  std::vector<bool> out(setup.sections.size(), false);
  for (const Passage& run : setup.runs)
    for (const Bend& b : run.bends)
      for (std::size_t i = 0; i < out.size(); ++i)
        if (run.inserted_m.maxCoeff() - b.at_m > setup.sections[i].from_tip_m) out[i] = true;
  return out;
}

void set_free(std::span<const double> free, Setup& setup) {
  const std::vector<bool> has = bent(setup);
  for (std::size_t i = 0, k = 0; i < has.size(); ++i)
    if (has[i]) setup.sections[i].EI_N_m2 *= free[k++];
}

std::vector<EffectParameter> free_numbers(const Setup& setup) {
  const std::vector<bool> has = bent(setup);
  std::vector<EffectParameter> out;
  for (std::size_t i = 0; i < has.size(); ++i)
    if (has[i])
      out.push_back({fmt::format("EI_scale[{}]", i), "1",
                     fmt::format("bending stiffness of section {} against that declared", i), 1, 0.3, 0.1, 10, true});
  return out;
}

std::unique_ptr<curves::Set> read(const JsonValue& file) {
  const JsonObject root(file, set_keys), rig(root["rig"], rig_keys), noise(root["noise"], noise_keys);
  Setup setup;
  const curves::Instrument instrument = instrument_keys.read(root);
  setup.radius_m = instrument.radius_m, setup.sections = instrument.sections;
  setup.friction = rig.positive("friction");
  std::vector<curves::Run> runs;
  for (const JsonValue& value : root.list("runs")) runs.push_back(read_run(value, noise, setup, runs));
  if (runs.empty()) root.refuse("runs");
  std::vector<curves::Run> with_noise = runs;
  curves::declared_noise(with_noise);
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const curves::Channel& hand = with_noise[r].channels[0];
    setup.runs[r].measured_N = hand.measured, setup.runs[r].sigma_N = hand.sigma;
  }
  const std::vector<EffectParameter> free = free_numbers(setup);
  auto set = std::make_unique<curves::SetOf<Setup>>(
      setup, runs, free, set_free, hand_forces,
      std::vector<Effect>{wall_friction(), soft_tip(), coating_loss(), clearance(), stick_slip(), zero_offset(),
                          force_drift()});
  curves::declare(root, *set);
  return set;
}

}  // namespace

curves::Kind kind() {
  return {"push_pull", "force at the hand of a wire that is fed into a path and pulled out", read,
          instrument_keys.with(
              {&set_keys, &rig_keys, &noise_keys, &run_keys, &path_keys, &bend_keys, &curves::effect_keys})};
}

}  // namespace ostium::data::push_pull
