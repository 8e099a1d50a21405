#include "data/identification/measurement/view_reader.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "core/base/units.h"
#include "data/formats/dicom/dicom_geometry.h"
#include "data/identification/measurement/number_lists.h"
#include "data/identification/measurement/projection_keys.h"

namespace ostium::data {

namespace {

using Eigen::Vector3d;
using units::mm, units::degree;

constexpr double square = 1e-3;                           // how far u and v may be from unit length and a right angle
constexpr double least_sid_mm = 200, most_sid_mm = 3000;  // from a hand-held detector to a room
constexpr double least_width_mm = 20, most_width_mm = 1000;
constexpr double same_angle = 1 * degree;

double angle_between(const Vector3d& a, const Vector3d& b) { return std::acos(std::clamp(a.dot(b), -1.0, 1.0)); }

void require_axes(const JsonObject& entry, const Camera& camera) {
  for (const char* axis : {"u", "v"}) {
    const double length = vector3(entry[axis]).norm();
    if (std::fabs(length - 1) > square)
      entry[axis].refuse(fmt::format("three numbers of length 1, got {:.4g}", length));
  }
  if (std::fabs(camera.u.dot(camera.v)) > square) entry.refuse("v");
}

/// A factor that would bring `value` into the range, as a hint at its unit.
std::string unit_hint(double value, double least, double most) {
  for (const auto& [factor, unit] : {std::pair(1000.0, "m"), std::pair(10.0, "cm"), std::pair(25.4, "inches")})
    if (value * factor >= least && value * factor <= most) return fmt::format("; are these {}?", unit);
  return "";
}

void require_distances(const JsonObject& entry, const Camera& camera) {
  const double sid_mm = camera.source_to_detector_m() / mm, width_mm = camera.pixel_m * camera.columns / mm;
  if (!(sid_mm >= least_sid_mm && sid_mm <= most_sid_mm))
    entry.value().fail(fmt::format("{}: its source is {:.4g} mm from its detector; expected {:g} to {:g} mm{}",
                                   entry.value().path(), sid_mm, least_sid_mm, most_sid_mm,
                                   unit_hint(sid_mm, least_sid_mm, most_sid_mm)));
  if (!(width_mm >= least_width_mm && width_mm <= most_width_mm))
    entry.value().fail(
        fmt::format("{}: {} columns of {:g} mm are {:.4g} mm wide; expected a detector of {:g} to {:g} mm{}",
                    entry.value().path(), camera.columns, camera.pixel_m / mm, width_mm, least_width_mm, most_width_mm,
                    unit_hint(width_mm, least_width_mm, most_width_mm)));
  const Vector3d foot = camera.source_m + camera.source_to_detector_m() * camera.outwards();
  const double off_mm = (foot - camera.pixel_in_room(camera.middle_px())).norm() / mm;
  if (off_mm > width_mm)
    entry.value().fail(
        fmt::format("{}: its source faces a point {:.4g} mm from the middle of its detector, which is "
                    "{:.4g} mm wide; expected source_mm, pixel_0_0_mm, u and v in one frame",
                    entry.value().path(), off_mm, width_mm));
}

void require_angles(const JsonObject& entry, const Camera& camera) {
  if (!entry.has("primary_deg") || !entry.has("secondary_deg")) return;
  const double primary = entry.number("primary_deg"), secondary = entry.number("secondary_deg");
  const Vector3d outwards = camera.outwards();
  const double off = angle_between(outwards_at({primary * degree, secondary * degree}), outwards);
  if (off < same_angle) return;
  const bool radians = angle_between(outwards_at({primary, secondary}), outwards) < same_angle;
  const GantryAngles are = gantry_angles(outwards);
  entry["primary_deg"].fail(fmt::format(
      "{0}.primary_deg and secondary_deg are {1:g} and {2:g}, {3:.3g} degrees from where source and detector are; "
      "expected {4:.4g} and {5:.4g}{6}",
      entry.value().path(), primary, secondary, off / degree, are.primary_rad / degree, are.secondary_rad / degree,
      radians ? "; are these radians?" : " (x to the patient's left, y to the back, z to the head), or neither"));
}

Camera written_out(const JsonObject& entry) {
  for (const char* key : {"source_mm", "pixel_0_0_mm", "u", "v", "pixel_mm", "columns", "rows"})
    if (!entry.has(key))
      entry.value().fail(fmt::format("{}.{} is missing; expected the view's geometry, or dicom in its place",
                                     entry.value().path(), key));
  Camera camera;
  camera.source_m = vector3(entry["source_mm"]) * mm, camera.pixel_0_0_m = vector3(entry["pixel_0_0_mm"]) * mm;
  camera.u = vector3(entry["u"]), camera.v = vector3(entry["v"]);
  camera.pixel_m = entry.positive("pixel_mm") * mm;
  camera.columns = entry.whole("columns"), camera.rows = entry.whole("rows");
  require_axes(entry, camera);
  camera.u.normalize();
  camera.v = (camera.v - camera.u * camera.u.dot(camera.v)).normalized();
  require_distances(entry, camera);
  require_angles(entry, camera);
  return camera;
}

/// The side of the patient that letters name, strongest first: x to the left, y to the back, z to the head.
Vector3d towards(const std::string& letters) {
  Vector3d out = Vector3d::Zero();
  double weight = 1;
  for (const char letter : letters) {
    if (const auto plus = std::string("LPH").find(letter); plus != std::string::npos) out[plus] += weight;
    if (const auto minus = std::string("RAF").find(letter); minus != std::string::npos) out[minus] -= weight;
    weight /= 2;
  }
  return out.stableNormalized();
}

/// A picture that was mirrored or turned after it was taken is not what the angles say.
void require_sides(const std::string& file, const DicomGeometry& tags, const Camera& camera) {
  constexpr double opposite = -0.5;  // cosine: letters are coarse
  if (towards(tags.right_is_to).dot(camera.u) < opposite || towards(tags.down_is_to).dot(camera.v) < opposite)
    throw LoadError(
        fmt::format("{}: (0020,0020) PatientOrientation is {}\\{}, the opposite of what the positioner's "
                    "angles {:g} and {:g} show; expected a picture that is not mirrored or turned",
                    file, tags.right_is_to, tags.down_is_to, tags.primary_deg, tags.secondary_deg));
}

/// DICOM's rows go down the picture, away from the head; its columns to the patient's left in an AP view.
Camera of_dicom(const JsonObject& entry, const std::string& set_file) {
  for (const JsonKey& key : projection_keys::view.keys)
    if (key.name != "id" && key.name != "dicom" && key.name != "isocentre_mm" && entry.has(key.name))
      entry[key.name].fail(fmt::format("{}.{} and dicom; expected one of them", entry.value().path(), key.name));
  const std::string file = (std::filesystem::path(set_file).parent_path() / entry.text("dicom")).string();
  const DicomGeometry tags = read_dicom_geometry(file);
  const Vector3d isocentre =
      entry.has("isocentre_mm") ? Vector3d(vector3(entry["isocentre_mm"]) * mm) : Vector3d(Vector3d::Zero());
  const GantryAngles angles{tags.primary_deg * degree, tags.secondary_deg * degree};
  const Vector3d outwards = outwards_at(angles);
  Camera camera;
  camera.pixel_m = tags.pixel_mm * mm, camera.columns = tags.columns, camera.rows = tags.rows;
  camera.u = {std::cos(angles.primary_rad), std::sin(angles.primary_rad), 0};
  camera.v = camera.u.cross(outwards);
  require_sides(file, tags, camera);
  camera.source_m = isocentre - tags.source_to_isocentre_mm * mm * outwards;
  const Vector3d middle = camera.source_m + tags.source_to_detector_mm * mm * outwards;
  const Eigen::Vector2d half = camera.pixel_m * camera.middle_px();
  camera.pixel_0_0_m = middle - half.x() * camera.u - half.y() * camera.v;
  require_distances(entry, camera);
  return camera;
}

}  // namespace

MeasuredCArm read_view(const JsonValue& value, const MeasurementSet& set) {
  const JsonObject entry(value, projection_keys::view);
  MeasuredCArm arm;
  arm.id = entry.text("id");
  for (const MeasuredCArm& other : set.views)
    if (other.id == arm.id) entry["id"].refuse("an id that no other view has");
  if (!entry.has("dicom") && entry.has("isocentre_mm"))
    entry["isocentre_mm"].fail(value.path() + ".isocentre_mm is for views with dicom");
  arm.camera = entry.has("dicom") ? of_dicom(entry, set.file) : written_out(entry);
  return arm;
}

}  // namespace ostium::data
