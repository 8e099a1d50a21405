#include "data/identification/measurement/measurement_reader.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "data/identification/measurement/measurement_keys.h"
#include "vascular/mesh.h"

namespace ostium {

namespace {

namespace keys = measurement_keys;
using Eigen::Vector3d;

constexpr double mm = 1e-3, Nmm2 = 1e-6, per_mm = 1e3, degree = std::numbers::pi / 180;
constexpr double gap_tolerance_mm = 1e-6;

/// `value` as `count` numbers; the message tells how many there are.
std::vector<double> numbers(const JsonValue& value, std::size_t count) {
  if (value.type != JsonValue::Type::array) value.refuse(fmt::format("{} numbers, [...]", count));
  std::vector<double> result;
  for (const JsonValue& item : value.items) {
    if (item.type != JsonValue::Type::number) item.refuse("a number");
    result.push_back(item.number);
  }
  if (result.size() != count) value.refuse(fmt::format("{} numbers, got {}", count, result.size()));
  return result;
}
Vector3d vector3(const JsonValue& value) { return Eigen::Map<const Vector3d>(numbers(value, 3).data()); }
Eigen::Vector2d vector2(const JsonValue& value) { return Eigen::Map<const Eigen::Vector2d>(numbers(value, 2).data()); }

/// Generalised winding number of a point (van Oosterom, Strackee 1983): 1 inside.
double winding_number(const Mesh& mesh, const Vector3d& p) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    const Vector3d a = mesh.vertices[t[0]] - p, b = mesh.vertices[t[1]] - p, c = mesh.vertices[t[2]] - p;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (4 * std::numbers::pi);
}

Section read_section(const JsonObject& entry, const MeasuredInstrument& instrument, double& reached_mm) {
  const auto ends = numbers(entry["from_tip_mm"], 2);
  if (std::fabs(ends[0] - reached_mm) > gap_tolerance_mm)
    entry["from_tip_mm"].refuse(fmt::format("it to begin at {} mm, where the one before it ends", reached_mm));
  if (!(ends[1] > ends[0]) || ends[1] > instrument.length_m / mm + gap_tolerance_mm) entry.refuse("from_tip_mm");
  Section s;
  s.from_tip_m = reached_mm * mm, s.to_tip_m = ends[1] * mm;
  reached_mm = ends[1];
  s.EI1_N_m2 = s.EI2_N_m2 = entry.positive("EI_Nmm2") * Nmm2;
  s.GJ_N_m2 = entry.positive("GJ_Nmm2") * Nmm2;
  // Core takes no rod without weight; this is a thousandth of the lightest wire's.
  s.kg_per_m = std::max(entry.not_negative("kg_per_mm") / mm, 1e-6);
  s.radius_m = instrument.radius_m, s.inner_radius_m = instrument.inner_radius_m;
  if (entry.has("rest_curvature_per_mm"))
    s.rest_curvature_per_m.head<2>() = vector2(entry["rest_curvature_per_mm"]) * per_mm;
  return s;
}

/// Core has limits of its own, on numbers that are of the right sign and still no instrument's.
void require_rod(const JsonObject& entry, const MeasuredInstrument& instrument) {
  try {
    check({instrument.name, instrument.sections, equal_elements(instrument.sections, 64), {}, {}});
  } catch (const std::invalid_argument& error) {
    entry["sections"].fail(fmt::format("{} make no rod: {}", entry["sections"].path, error.what()));
  }
}

MeasuredInstrument read_instrument(const JsonValue& value) {
  const JsonObject entry(value, keys::instrument);
  MeasuredInstrument instrument;
  instrument.name = entry.text("name");
  instrument.length_m = entry.positive("total_length_mm") * mm;
  instrument.radius_m = entry.positive("outer_radius_mm") * mm;
  instrument.inner_radius_m = entry.not_negative("inner_radius_mm") * mm;
  if (instrument.inner_radius_m >= instrument.radius_m) entry.refuse("inner_radius_mm");
  double reached_mm = 0;
  for (const JsonValue& section : entry.list("sections"))
    instrument.sections.push_back(read_section(JsonObject(section, keys::section), instrument, reached_mm));
  if (std::fabs(reached_mm - instrument.length_m / mm) > gap_tolerance_mm)
    entry["sections"].fail(fmt::format("{} end {} mm from the tip; expected them to reach total_length_mm, {} mm",
                                       entry["sections"].path, reached_mm, instrument.length_m / mm));
  require_rod(entry, instrument);
  return instrument;
}

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

void read_environment(const JsonObject& entry, MeasurementSet& set) {
  set.gravity_m_s2 = vector3(entry["gravity_m_s2"]);
  if (entry["vessel"].type == JsonValue::Type::null) return;
  const JsonObject vessel(entry["vessel"], keys::vessel);
  static const std::vector<std::string> units = {"mm", "cm", "m", "in"};
  set.vessel = MeasuredVessel{vessel.text("mesh"), units[vessel.choice("units", units)],
                              vessel.not_negative("friction"), nullptr};
}

void read_imaging(const JsonObject& entry, MeasurementSet& set) {
  if (entry["noise_sigma_mm"].type != JsonValue::Type::null)
    set.imaging.noise_sigma_m = entry.positive("noise_sigma_mm") * mm;
  set.imaging.registration_free = entry.choice("registration", {"given", "free"}) == 1;
  set.imaging.tip_offset_free = entry.choice("tip_offset", {"none", "free"}) == 1;
}

DeclaredEffect read_effect(const JsonValue& value, const MeasurementSet& set) {
  const JsonObject entry(value, keys::effect);
  DeclaredEffect effect;
  effect.id = entry.text("id");
  effect.place = fmt::format("{}:{}: {}", *value.file, value.line, value.path);
  if (entry.has("instrument") && entry["instrument"].type != JsonValue::Type::null) {
    const double index = entry.number("instrument");
    if (index != std::floor(index) || index < 0 || index >= static_cast<double>(set.instruments.size()))
      entry["instrument"].refuse(fmt::format("the index of an instrument, 0 to {}", set.instruments.size() - 1));
    effect.instrument = static_cast<int>(index);
  }
  if (entry["parameters"].type != JsonValue::Type::object) entry.refuse("parameters");
  for (const auto& [name, parameter] : entry["parameters"].members) {
    if (parameter.type != JsonValue::Type::number) parameter.refuse("a number");
    effect.parameters.emplace_back(name, parameter.number);
  }
  return effect;
}

EndState read_base(const JsonObject& entry) {
  EndState base;
  base.p_W = vector3(entry["position_mm"]) * mm;
  const Vector3d tangent = vector3(entry["tangent"]), up = vector3(entry["up"]);
  if (!(tangent.norm() > 1e-12)) entry.refuse("tangent");
  const Vector3d d3 = tangent.normalized(), across = up - d3 * d3.dot(up);
  if (!(across.norm() > 1e-6 * up.norm())) entry.refuse("up");
  Eigen::Matrix3d R;
  R.col(0) = across.normalized(), R.col(2) = d3;
  R.col(1) = d3.cross(Vector3d(R.col(0)));
  const Eigen::Quaterniond q(R);
  base.q_W = {q.w(), q.x(), q.y(), q.z()};
  return base;
}

Placement read_placement(const JsonValue& value, const MeasuredInstrument& instrument) {
  const JsonObject entry(value, keys::placement);
  Placement p;
  const double length_mm = instrument.length_m / mm, inserted_mm = entry.positive("inserted_length_mm");
  if (inserted_mm > length_mm + gap_tolerance_mm)
    entry["inserted_length_mm"].refuse(fmt::format("at most {} mm, the length of \"{}\"", length_mm, instrument.name));
  p.inserted_m = std::min(inserted_mm, length_mm) * mm;
  p.roll_rad = entry.number("roll_deg") * degree;
  if (!entry.has("shaft_mm")) return p;
  const double shaft_mm = entry.not_negative("shaft_mm");
  if (inserted_mm + shaft_mm > length_mm + gap_tolerance_mm)
    entry["shaft_mm"].refuse(
        fmt::format("at most {} mm, what of \"{}\" is not inserted", length_mm - inserted_mm, instrument.name));
  p.shaft_m = shaft_mm * mm;
  return p;
}

void read_set(const JsonObject& entry, const MeasurementSet& set, Experiment& e) {
  const auto& list = entry.list("set");
  if (list.size() != set.instruments.size())
    entry["set"].refuse(
        fmt::format("one entry for each of {} instruments, got {}", set.instruments.size(), list.size()));
  for (std::size_t i = 0; i < list.size(); ++i) e.set.push_back(read_placement(list[i], set.instruments[i]));
}

void read_specimen(const JsonObject& entry, const MeasurementSet& set, Experiment& e) {
  e.specimen.resize(set.instruments.size());
  if (!entry.has("specimen")) return;
  const auto& list = entry.list("specimen");
  if (list.size() != set.instruments.size())
    entry["specimen"].refuse(
        fmt::format("one entry for each of {} instruments, got {}", set.instruments.size(), list.size()));
  for (std::size_t i = 0; i < list.size(); ++i)
    if (list[i].type != JsonValue::Type::null)
      e.specimen[i] = vector2(JsonObject(list[i], keys::specimen)["rest_curvature_per_mm"]) * per_mm;
}

void read_measured(const JsonObject& entry, Experiment& e) {
  const int count = entry.has("centreline_mm") + entry.has("tip_mm") + entry.has("radius_of_curvature_mm");
  if (count != 1)
    entry.value().fail(
        fmt::format("{} has {} of centreline_mm, tip_mm and radius_of_curvature_mm; expected exactly one",
                    entry.value().path, count));
  if (entry.has("centreline_mm")) {
    e.kind = Experiment::Kind::centreline;
    for (const JsonValue& point : entry.list("centreline_mm")) e.points_m.push_back(vector3(point) * mm);
    if (e.points_m.size() < 2) entry.refuse("centreline_mm");
  } else if (entry.has("tip_mm")) {
    e.kind = Experiment::Kind::tip;
    e.points_m = {vector3(entry["tip_mm"]) * mm};
  } else {
    e.kind = Experiment::Kind::radius;
    e.radius_m = entry.positive("radius_of_curvature_mm") * mm;
  }
}

/// Core loads the end of what reaches furthest.
void require_loaded_tip(const JsonObject& entry, const Experiment& e) {
  for (const Placement& p : e.set)
    if (!e.tip_force_N.isZero() && p.inserted_m > e.set.back().inserted_m)
      entry["tip_force_N"].refuse("no load where the innermost tip is inside another instrument");
}

Experiment read_experiment(const JsonValue& value, const MeasurementSet& set) {
  const JsonObject entry(value, keys::experiment);
  Experiment e;
  e.id = entry.text("id");
  e.place = value.path;
  for (const Experiment& other : set.experiments)
    if (other.id == e.id) entry["id"].refuse("an id that no other experiment has; " + other.place + " has it");
  e.base = read_base(JsonObject(entry["base"], keys::base));
  read_set(entry, set, e);
  read_specimen(entry, set, e);
  if (entry.has("tip_force_N")) e.tip_force_N = vector3(entry["tip_force_N"]);
  if (entry.has("proximal_force_N")) e.proximal_force_N = entry.number("proximal_force_N");
  if (entry.has("elapsed_s")) e.elapsed_s = entry.not_negative("elapsed_s");
  if (entry.has("group")) e.group = entry.text("group");
  read_measured(entry, e);
  require_loaded_tip(entry, e);
  return e;
}

std::shared_ptr<const SurfaceDescription> read_wall(const MeasurementSet& set) {
  const std::string mesh = (std::filesystem::path(set.file).parent_path() / set.vessel->mesh).string();
  const auto fail = [&](const std::string& what) {
    throw LoadError(set.file + ": environment.vessel.mesh is \"" + set.vessel->mesh + "\": " + what);
  };
  const LengthUnit unit = set.vessel->units == "mm"   ? LengthUnit::millimetre
                          : set.vessel->units == "cm" ? LengthUnit::centimetre
                          : set.vessel->units == "m"  ? LengthUnit::metre
                                                      : LengthUnit::inch;
  Mesh read;
  try {
    read = read_mesh(mesh, unit).mesh;
  } catch (const MeshError& error) {
    fail(error.what());
  }
  if (volume_m3(read) < 0)
    for (auto& t : read.triangles) std::swap(t[1], t[2]);
  for (const Experiment& e : set.experiments)
    if (winding_number(read, e.base.p_W) < 0.5)
      fail(fmt::format("{}.base.position_mm lies outside of it; expected a point within the lumen", e.place));
  auto wall = std::make_shared<SurfaceDescription>();
  wall->frames = {read.vertices};
  wall->triangles = read.triangles;
  return wall;
}

MeasurementSet read(const JsonValue& file) {
  const JsonObject root(file, keys::set);
  MeasurementSet set;
  set.file = *file.file;
  if (root.text("schema") != "ostium-measurement/1") root.refuse("schema");
  set.title = root.text("title");
  set.source = root.text("source");
  read_instruments(root, set);
  read_environment(JsonObject(root["environment"], keys::environment), set);
  read_imaging(JsonObject(root["imaging"], keys::imaging), set);
  if (root.has("effects"))
    for (const JsonValue& value : root.list("effects")) set.effects.push_back(read_effect(value, set));
  for (const JsonValue& value : root.list("experiments")) set.experiments.push_back(read_experiment(value, set));
  if (set.experiments.empty()) root.refuse("experiments");
  return set;
}

}  // namespace

std::string measurement_file(const std::string& path) {
  return std::filesystem::is_directory(path) ? (std::filesystem::path(path) / "measurement.json").string() : path;
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

}  // namespace ostium
