#include "data/identification/measurement/measurement_reader.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "core/base/units.h"
#include "data/catalogue/instrument/instrument.h"
#include "data/formats/paths.h"
#include "data/identification/measurement/experiment_reader.h"
#include "data/identification/measurement/measured_numbers.h"
#include "data/identification/measurement/measured_wall.h"
#include "data/identification/measurement/measurement_keys.h"
#include "data/identification/measurement/measurement_parts.h"
#include "data/identification/measurement/number_lists.h"
#include "data/identification/measurement/projection_reader.h"

namespace ostium::data {

namespace {

using units::mm, units::Nmm2, units::per_mm;

core::Section read_section(const JsonObject& entry, const MeasuredInstrument& instrument, double& reached_mm) {
  const auto ends = numbers(entry["from_tip_mm"], 2);
  if (std::fabs(ends[0] - reached_mm) > gap_tolerance_mm)
    entry["from_tip_mm"].refuse(fmt::format("it to begin at {} mm, where the one before it ends", reached_mm));
  if (!(ends[1] > ends[0]) || ends[1] > instrument.length_m / mm + gap_tolerance_mm) entry.refuse("from_tip_mm");
  core::Section s;
  s.from_tip_m = reached_mm * mm, s.to_tip_m = ends[1] * mm;
  reached_mm = ends[1];
  s.EI1_N_m2 = s.EI2_N_m2 = entry.positive("EI_Nmm2") * Nmm2;
  s.GJ_N_m2 = entry.positive("GJ_Nmm2") * Nmm2;
  // Core refuses rods without weight; this is a thousandth of the lightest wire's.
  s.kg_per_m = std::max(entry.not_negative("kg_per_mm") / mm, 1e-6);
  s.radius_m = instrument.radius_m, s.inner_radius_m = instrument.inner_radius_m;
  if (entry.has("rest_curvature_per_mm"))
    s.rest_curvature_per_m.head<2>() = vector2(entry["rest_curvature_per_mm"]) * per_mm;
  return s;
}

/// Core has limits of its own, for numbers of the right sign that no instrument has.
void require_rod(const JsonObject& entry, const MeasuredInstrument& instrument) {
  try {
    core::check({instrument.name, instrument.sections, equal_elements(instrument.sections, 64), {}, {}});
  } catch (const std::invalid_argument& error) {
    entry["sections"].fail(fmt::format("{} make no rod: {}", entry["sections"].path(), error.what()));
  }
}

MeasuredInstrument read_instrument(const JsonValue& value) {
  const JsonObject entry(value, measurement_keys::instrument);
  MeasuredInstrument instrument;
  instrument.name = entry.text("name");
  instrument.length_m = entry.positive("total_length_mm") * mm;
  instrument.radius_m = entry.positive("outer_radius_mm") * mm;
  instrument.inner_radius_m = entry.not_negative("inner_radius_mm") * mm;
  if (instrument.inner_radius_m >= instrument.radius_m) entry.refuse("inner_radius_mm");
  double reached_mm = 0;
  for (const JsonValue& section : entry.list("sections"))
    instrument.sections.push_back(read_section(JsonObject(section, measurement_keys::section), instrument, reached_mm));
  if (std::fabs(reached_mm - instrument.length_m / mm) > gap_tolerance_mm)
    entry["sections"].fail(fmt::format("{} end {} mm from the tip; expected them to reach total_length_mm, {} mm",
                                       entry["sections"].path(), reached_mm, instrument.length_m / mm));
  require_rod(entry, instrument);
  return instrument;
}

}  // namespace

void read_instruments(const JsonObject& root, MeasurementSet& set) {
  for (const JsonValue& value : root.list("instruments")) {
    set.instruments.push_back(read_instrument(value));
    const std::size_t n = set.instruments.size();
    if (n > 1 && set.instruments[n - 1].radius_m > set.instruments[n - 2].inner_radius_m)
      value.find("outer_radius_mm")
          ->refuse(fmt::format("at most {} mm, the lumen of the instrument around it (outermost first)",
                               set.instruments[n - 2].inner_radius_m / mm));
  }
  if (set.instruments.empty()) root.refuse("instruments");
}

void read_environment(const JsonValue& environment, MeasurementSet& set) {
  const JsonObject entry(environment, measurement_keys::environment);
  set.gravity_m_s2 = vector3(entry["gravity_m_s2"]);
  if (entry["vessel"].type == JsonValue::Type::null) return;
  const JsonObject vessel(entry["vessel"], measurement_keys::vessel);
  static const std::vector<std::string> units = {"mm", "cm", "m", "in"};
  set.vessel = MeasuredVessel{vessel.text("mesh"), units[vessel.choice("units", units)],
                              vessel.not_negative("friction"), nullptr};
}

namespace {

void read_imaging(const JsonObject& entry, MeasurementSet& set) {
  if (const auto noise_mm = entry.number_or_null("noise_sigma_mm")) set.imaging.noise_sigma_m = *noise_mm * mm;
  set.imaging.registration_free = entry.choice("registration", {"given", "free"}) == 1;
  set.imaging.tip_offset_free = entry.choice("tip_offset", {"none", "free"}) == 1;
}

DeclaredEffect read_effect(const JsonValue& value, const MeasurementSet& set) {
  const JsonObject entry(value, measurement_keys::effect);
  DeclaredEffect effect;
  effect.id = entry.text("id");
  effect.place = fmt::format("{}:{}: {}", *value.file, value.line, value.path());
  if (const auto index = entry.number_or_null("instrument")) {
    if (*index != std::floor(*index) || *index >= static_cast<double>(set.instruments.size()))
      entry["instrument"].refuse(fmt::format("the index of an instrument, 0 to {}", set.instruments.size() - 1));
    effect.instrument = static_cast<int>(*index);
  }
  for (const auto& [name, parameter] : entry["parameters"].members) {
    if (parameter.type != JsonValue::Type::number) parameter.refuse("a number");
    effect.parameters.emplace_back(name, parameter.number);
  }
  return effect;
}

}  // namespace

void require_noise_above_rounding(const JsonValue& noise, const MeasurementSet& set) {
  if (!set.imaging.noise_sigma_m) return;
  const std::string doubt = doubt_of_noise_below_rounding(
      measured_numbers(set), *set.imaging.noise_sigma_m / set.unit().size, set.unit().name);
  if (!doubt.empty()) noise.fail(noise.path() + " " + doubt + "; expected the scatter of repeats, or null");
}

void read_effects(const JsonObject& root, MeasurementSet& set) {
  if (!root.has("effects")) return;
  for (const JsonValue& value : root.list("effects")) set.effects.push_back(read_effect(value, set));
}

namespace {

/// Of a set of version 2; empty for version 1, which has no kinds.
std::string kind_of(const JsonValue& file) {
  const JsonValue *schema = file.find("schema"), *kind = file.find("kind");
  return schema && kind && schema->text == "ostium-measurement/2" ? kind->text : "";
}

/// Before its keys, which differ by version.
void require_known_version(const JsonValue& file) {
  const JsonValue* schema = file.find("schema");
  if (!schema || schema->type != JsonValue::Type::text) return;  // told by the key table
  if (schema->text != "ostium-measurement/1" && schema->text != "ostium-measurement/2")
    schema->refuse("\"ostium-measurement/1\", or \"ostium-measurement/2\" with a kind");
}

MeasurementSet read(const JsonValue& file) {
  require_known_version(file);
  if (kind_of(file) == "projections") return read_projections(file);
  const JsonObject root(file, measurement_keys::set);
  MeasurementSet set;
  set.file = *file.file;
  if (root.text("schema") != "ostium-measurement/1") root.refuse("schema");
  set.title = root.text("title");
  set.source = root.text("source");
  read_instruments(root, set);
  read_environment(root["environment"], set);
  read_imaging(JsonObject(root["imaging"], measurement_keys::imaging), set);
  read_effects(root, set);
  for (const JsonValue& value : root.list("experiments")) set.experiments.push_back(read_experiment(value, set));
  if (set.experiments.empty()) root.refuse("experiments");
  require_noise_above_rounding(*root["imaging"].find("noise_sigma_mm"), set);
  return set;
}

}  // namespace

std::string measurement_file(const std::string& path) {
  return is_folder(path) ? (std::filesystem::path(path) / "measurement.json").string() : path;
}

MeasurementSet read_measurement(const std::string& file, const std::string& text) {
  return read(parse_json(file, text));
}

MeasurementSet load_measurement(const std::string& path) {
  const std::string file = measurement_file(path);
  MeasurementSet set = read(load_json(file));
  if (set.vessel) set.vessel->wall = read_wall(set);
  return set;
}

}  // namespace ostium::data
