#include "data/identification/measurement/experiment_reader.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "data/catalogue/instrument/instrument.h"
#include "data/identification/measurement/measurement_keys.h"
#include "data/identification/measurement/number_lists.h"

namespace ostium::data {

namespace {

using Eigen::Vector3d;

using units::mm, units::per_mm, units::degree;

core::EndState read_base(const JsonObject& entry) {
  core::EndState base;
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
  const JsonObject entry(value, measurement_keys::placement);
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
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (list[i].type == JsonValue::Type::null) continue;
    const JsonObject specimen(list[i], measurement_keys::specimen);
    e.specimen[i] = vector2(specimen["rest_curvature_per_mm"]) * per_mm;
    const double most_per_m = 1 / set.instruments[i].radius_m;
    if (!(e.specimen[i]->norm() < most_per_m))
      specimen["rest_curvature_per_mm"].refuse(
          fmt::format("less than {:.3g}, one by the outer radius", most_per_m / per_mm));
  }
}

void read_measured(const JsonObject& entry, Experiment& e) {
  const int count = entry.has("centreline_mm") + entry.has("tip_mm") + entry.has("radius_of_curvature_mm");
  if (count != 1)
    entry.value().fail(
        fmt::format("{} has {} of centreline_mm, tip_mm and radius_of_curvature_mm; expected exactly one",
                    entry.value().path(), count));
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

/// Core applies the tip load to the end of the instrument that reaches furthest.
void require_loaded_tip(const JsonObject& entry, const Experiment& e) {
  for (const Placement& p : e.set)
    if (!e.tip_force_N.isZero() && p.inserted_m > e.set.back().inserted_m)
      entry["tip_force_N"].refuse("no load where the innermost tip is inside another instrument");
}

}  // namespace

Experiment read_setting(const JsonObject& entry, const MeasurementSet& set) {
  Experiment e;
  e.id = entry.text("id");
  e.place = entry.value().path();
  for (const Experiment& other : set.experiments)
    if (other.id == e.id) entry["id"].refuse("an id that no other experiment has; " + other.place + " has it");
  e.base = read_base(JsonObject(entry["base"], measurement_keys::base));
  read_set(entry, set, e);
  read_specimen(entry, set, e);
  if (entry.has("tip_force_N")) e.tip_force_N = vector3(entry["tip_force_N"]);
  if (entry.has("proximal_force_N")) e.proximal_force_N = entry.number("proximal_force_N");
  if (entry.has("elapsed_s")) e.elapsed_s = entry.not_negative("elapsed_s");
  if (entry.has("group")) e.group = entry.text("group");
  require_loaded_tip(entry, e);
  return e;
}

Experiment read_experiment(const JsonValue& value, const MeasurementSet& set) {
  const JsonObject entry(value, measurement_keys::experiment);
  Experiment e = read_setting(entry, set);
  read_measured(entry, e);
  return e;
}

}  // namespace ostium::data
