#include "data/identification/curves/push_pull/push_pull.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/units.h"

namespace ostium::data::push_pull {

namespace {

using Eigen::VectorXd;
using units::degree, units::mm, units::Nmm2;

const JsonObjectKeys set_keys = {
    "push_pull",
    curves::with_common_keys(
        "push_pull",
        {{"instruments", true, "the instrument, one", json_type::list_of(json_type::object("push_instrument"), 1, 1)},
         {"rig", true, "what is known of the path's walls, an object", json_type::object("push_rig")},
         {"noise", true, "standard deviations, an object", json_type::object("push_noise")},
         {"runs", true, curves::one_or_more, json_type::list_of(json_type::object("push_run"), 1)}})};

const JsonObjectKeys instrument_keys = {
    "push_instrument",
    {{"name", true, "what people call it, a text", json_type::text()},
     {"outer_radius_mm", true, "its outer radius in mm, > 0", json_type::number(above_zero)},
     {"length_mm", false, "its length in mm, > 0", json_type::number(above_zero)},
     {"sections", true, "sections from the tip backwards, without gaps",
      json_type::list_of(json_type::object("push_section"), 1)}}};

const JsonObjectKeys section_keys = {
    "push_section",
    {{"from_tip_mm", true, "two distances from the distal tip in mm, [from, to]", json_type::numbers(2)},
     {"EI_Nmm2", true, "bending stiffness in N mm2, > 0", json_type::number(above_zero)},
     {"GJ_Nmm2", false, "torsional stiffness in N mm2, > 0", json_type::number(above_zero)}}};

const JsonObjectKeys rig_keys = {
    "push_rig", {{"friction", true, "the coefficient of friction at the walls, > 0", json_type::number(above_zero)}}};

const JsonObjectKeys noise_keys = {
    "push_noise",
    {{"hand_force_N", true, "of the force at the hand in N, > 0, or null if it is unknown",
      json_type::null_or(json_type::number(above_zero))},
     {"tip_force_N", false, "of the force at the tip in N, >= 0, or null if it is unknown",
      json_type::null_or(json_type::number(from_zero))}}};

const JsonObjectKeys run_keys = {
    "push_run",
    {{"id", true, "a name that no other run has, a text", json_type::text()},
     {"group", false, "what runs share, a text", json_type::text()},
     {"path", true, "bends and bore, an object", json_type::object("push_path")},
     {"start_s", false, "when the run began in s, >= 0", json_type::number(from_zero)},
     {"time_s", false, "since the run began in s, one a sample", json_type::list_of(json_type::number(), 4)},
     {"inserted_mm", true, "from the path's entrance to the tip in mm, one a sample",
      json_type::list_of(json_type::number(), 4)},
     {"hand_force_N", true, "push of the hand in N, negative for a pull, one a sample",
      json_type::list_of(json_type::number(), 4)},
     {"tip_force_N", false, "push of the tip on what is before it in N, one a sample; 0 if not given",
      json_type::list_of(json_type::number(), 4)}}};

const JsonObjectKeys path_keys = {
    "push_path",
    {{"name", false, "what it is called, a text", json_type::text()},
     {"bore_mm", true, "inner diameter of the tube in mm, wider than the instrument", json_type::number(above_zero)},
     {"bends", true, "bends from the entrance on, a list", json_type::list_of(json_type::object("push_bend"))}}};

const JsonObjectKeys bend_keys = {
    "push_bend",
    {{"at_mm", true, "where it begins, from the entrance in mm, >= 0, behind the bend before",
      json_type::number(from_zero)},
     {"radius_mm", true, "of its axis in mm, > 0", json_type::number(above_zero)},
     {"angle_deg", false, "by which it turns in degrees, > 0; or length_mm", json_type::number(above_zero)},
     {"length_mm", false, "of its arc in mm, > 0; or angle_deg", json_type::number(above_zero)}}};

void read_instrument(const JsonValue& value, Setup& setup) {
  const JsonObject entry(value, instrument_keys);
  entry.text("name");
  setup.radius_m = entry.positive("outer_radius_mm") * mm;
  if (entry.has("length_mm")) entry.positive("length_mm");
  double end_mm = 0;
  for (const JsonValue& item : entry.list("sections")) {
    const JsonObject section(item, section_keys);
    const auto ends = section.numbers("from_tip_mm", 2);
    if (!(ends[1] > ends[0]) || std::fabs(ends[0] - end_mm) > 1e-6)
      section["from_tip_mm"].refuse(fmt::format("a section from {:g} mm on, where the one before it ends", end_mm));
    end_mm = ends[1];
    setup.sections.push_back({ends[0] * mm, ends[1] * mm, section.positive("EI_Nmm2") * Nmm2});
  }
}

void read_path(const JsonValue& value, double radius_m, Passage& passage) {
  const JsonObject path(value, path_keys);
  passage.bore_radius_m = path.positive("bore_mm") * mm / 2;
  if (passage.bore_radius_m <= radius_m)
    path["bore_mm"].refuse(fmt::format("a bore wider than the instrument, {:g} mm", 2 * radius_m / mm));
  for (const JsonValue& item : path.list("bends")) {
    const JsonObject entry(item, bend_keys);
    Bend bend{entry.not_negative("at_mm") * mm, entry.positive("radius_mm") * mm, 0};
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
    passage.run_before_m = before.run_before_m;
    for (Eigen::Index k = 1; k < before.inserted_m.size(); ++k)
      passage.run_before_m += std::fabs(before.inserted_m[k] - before.inserted_m[k - 1]);
  }
  curves::Channel hand{"hand_force_N", "force at the hand", "N", {}, {}};
  hand.measured = curves::read_samples_like(entry, "hand_force_N", run.along, "inserted_mm");
  if (noise["hand_force_N"].type == JsonValue::Type::number) {
    hand.sigma = VectorXd::Constant(run.samples(), noise.positive("hand_force_N"));
    const bool tip =
        entry.has("tip_force_N") && noise.has("tip_force_N") && noise["tip_force_N"].type == JsonValue::Type::number;
    for (Eigen::Index k = 0; k < run.samples() && tip; ++k) {
      // The tip's noise reaches the hand through the bends.
      double turned = 0;
      for (const Bend& b : passage.bends)
        turned += std::clamp((passage.inserted_m[k] - b.at_m) / b.radius_m, 0.0, b.angle_rad);
      const double gain = std::exp(setup.friction * passage.direction[k] * turned);
      hand.sigma[k] = std::hypot(hand.sigma[k], gain * noise.not_negative("tip_force_N"));
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
  read_instrument(root.list("instruments").at(0), setup);
  setup.friction = rig.positive("friction");
  std::vector<curves::Run> runs;
  for (const JsonValue& value : root.list("runs")) runs.push_back(read_run(value, noise, setup, runs));
  if (runs.empty()) root.refuse("runs");
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
  return {"push_pull",
          "force at the hand of a wire that is fed into a path and pulled out",
          read,
          {&set_keys, &instrument_keys, &section_keys, &rig_keys, &noise_keys, &run_keys, &path_keys, &bend_keys,
           &curves::effect_keys}};
}

}  // namespace ostium::data::push_pull
