#include "data/catalogue/case/markups_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "data/formats/json/json_value.h"
#include "vascular/geometry/mesh_files/formats.h"

namespace ostium::data {

namespace {

using units::mm;
constexpr double farthest_mm = 5000, thinnest_mm = 0.3, widest_mm = 50, longest_m = 3;
constexpr double apart_m = 1e-6;  // control points nearer than this are one

const JsonValue& member(const JsonValue& object, const char* key, JsonValue::Type type, const char* expected) {
  const JsonValue* const found = object.find(key);
  if (!found) object.fail(fmt::format("{} has no \"{}\"; expected {}", object.path(), key, expected));
  if (found->type != type) found->refuse(expected);
  return *found;
}

double number(const JsonValue& value, double least, double most, const char* what) {
  if (value.type != JsonValue::Type::number || !(value.number >= least && value.number <= most))
    value.refuse(fmt::format("{} from {:g} to {:g} mm", what, least, most));
  return value.number;
}

/// Of what stands in "position".
std::string axes_of(const JsonValue& curve) {
  const JsonValue* const system = curve.find("coordinateSystem");
  // Numbers are those of older Slicers (vtkMRMLStorageNode).
  if (!system || system->text == "LPS" || system->text == "1") return "LPS";
  if (system->text == "RAS" || system->text == "0") return "RAS";
  system->refuse("\"LPS\" or \"RAS\"");
}

const std::vector<JsonValue>& radii_of(const JsonValue& curve, std::size_t points) {
  constexpr const char* wanted =
      "a measurement \"Radius\" with one value a control point, as the curves of Extract Centerline (SlicerVMTK) have";
  if (const JsonValue* const measurements = curve.find("measurements"))
    for (const JsonValue& measurement : measurements->items) {
      const JsonValue* const name = measurement.find("name");
      if (!name || vascular::in_lower_case(name->text) != "radius") continue;
      const JsonValue& values = member(measurement, "controlPointValues", JsonValue::Type::array, wanted);
      if (const JsonValue* const unit = measurement.find("units"); unit && !unit->text.empty() && unit->text != "mm")
        unit->refuse("\"mm\"");
      if (values.items.size() != points) values.refuse(fmt::format("{} values, one a control point", points));
      return values.items;
    }
  curve.fail(fmt::format("{} has no radii; expected {}", curve.path(), wanted));
}

/// A line that turns back on itself at once, by more than its calibre, joins points out of order: the tube would run to
/// and fro in itself. `at`: which control points the course is made of.
void require_in_order(const std::vector<vascular::CoursePoint>& course, const std::vector<std::size_t>& at,
                      const JsonValue& points) {
  constexpr double back = -0.85;  // cosine: a turn by 148 degrees from one control point to the next
  for (std::size_t i = 1; i + 1 < course.size(); ++i) {
    const Eigen::Vector3d in = course[i].p - course[i - 1].p, out = course[i + 1].p - course[i].p;
    if (std::min(in.norm(), out.norm()) < course[i].radius_m || in.dot(out) > back * in.norm() * out.norm()) continue;
    const JsonValue& point = points.items[at[i]];
    point.fail(fmt::format(
        "the line turns back at {}, {:.3g} mm after {:.3g} mm: its points are not in order along the vessel; "
        "expected them in order, as Extract Centerline (SlicerVMTK) makes them",
        point.path(), out.norm() / mm, in.norm() / mm));
  }
}

std::vector<vascular::CoursePoint> course_of(const JsonValue& curve) {
  if (const JsonValue* const unit = curve.find("coordinateUnits"); unit && unit->text != "mm") unit->refuse("\"mm\"");
  const JsonValue& points = member(curve, "controlPoints", JsonValue::Type::array, "a list of control points");
  const std::vector<JsonValue>& radii = radii_of(curve, points.items.size());
  std::vector<vascular::CoursePoint> course;
  std::vector<std::size_t> at;
  double length_m = 0;
  for (std::size_t i = 0; i < points.items.size(); ++i) {
    // A point that was not yet, or is no longer, placed has a position that means nothing.
    if (const JsonValue* const status = points.items[i].find("positionStatus"); status && status->text != "defined")
      continue;
    const JsonValue& position = member(points.items[i], "position", JsonValue::Type::array, "[x, y, z] in mm");
    if (position.items.size() != 3) position.refuse("[x, y, z] in mm");
    vascular::CoursePoint point;
    for (int k = 0; k < 3; ++k)
      point.p[k] = mm * number(position.items[static_cast<std::size_t>(k)], -farthest_mm, farthest_mm, "a coordinate");
    point.radius_m = mm * number(radii[i], thinnest_mm, widest_mm, "a radius");
    const double step_m = course.empty() ? 1 : (point.p - course.back().p).norm();
    if (step_m < apart_m) continue;
    if (!course.empty()) length_m += step_m;
    course.push_back(point), at.push_back(i);
  }
  if (course.size() < 2) points.refuse("two control points at least, at different places");
  require_in_order(course, at, points);
  if (length_m > longest_m)
    points.refuse(fmt::format("a vessel {:g} m long at most, it has {:.3g}", longest_m, length_m));
  return course;
}

/// The last of `tubes` that `p` lies in; -1: none.
int tube_about(const Eigen::Vector3d& p, const std::vector<vascular::Tube>& tubes) {
  for (int t = static_cast<int>(tubes.size()) - 1; t >= 0; --t) {
    const vascular::TubeNode near =
        tubes[static_cast<std::size_t>(t)].at(nearest_s(tubes[static_cast<std::size_t>(t)], p));
    if ((near.p - p).norm() < near.radius_m) return t;
  }
  return -1;
}

Markups markups_of(const JsonValue& file) {
  constexpr const char* wanted = "a list of markups, as 3D Slicer saves it";
  Markups found;
  std::vector<vascular::Tube>& tubes = found.tubes;
  if (file.type != JsonValue::Type::object) file.refuse(wanted);
  for (const JsonValue& markup : member(file, "markups", JsonValue::Type::array, wanted).items) {
    const JsonValue& type = member(markup, "type", JsonValue::Type::text, "the kind of a markup");
    if (type.text != "Curve") continue;
    const std::string axes = axes_of(markup);
    if (!tubes.empty() && axes != found.axes)
      markup.fail(fmt::format("{} is in {}, and the curves before it are in {}; expected curves in the same axes",
                              markup.path(), axes, found.axes));
    found.axes = axes;
    const std::vector<vascular::CoursePoint> course = course_of(markup);
    const int parent = tube_about(course.front().p, tubes);
    tubes.push_back(make_tube(fmt::format("curve {}", tubes.size() + 1), parent, course));
  }
  if (tubes.empty()) file.fail("holds no curve; expected centrelines, as Extract Centerline (SlicerVMTK) makes them");
  return found;
}

}  // namespace

bool is_markups_file(const std::string& path) { return vascular::in_lower_case(path).ends_with(".mrk.json"); }
Markups read_markups(const std::string& file, const std::string& text) { return markups_of(parse_json(file, text)); }
Markups load_markups(const std::string& file) { return markups_of(load_json(file)); }

}  // namespace ostium::data
