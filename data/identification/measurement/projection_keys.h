#pragma once
/// The keys of a set of projections: a wire seen by the views of a C-arm, as pixels along it. What such a set shares
/// with others is in measurement_keys.h; the schema (data/schemas/measurement-projections.schema.json) is generated
/// from both.
#include <algorithm>

#include "data/identification/measurement/measurement_keys.h"

namespace ostium::data::projection_keys {

/// The keys of `of` without those named.
inline std::vector<JsonKey> keys_without(const JsonObjectKeys& of, const std::vector<std::string>& names) {
  std::vector<JsonKey> out;
  for (const JsonKey& key : of.keys)
    if (std::find(names.begin(), names.end(), key.name) == names.end()) out.push_back(key);
  return out;
}
inline std::vector<JsonKey> joined(std::vector<JsonKey> keys, const std::vector<JsonKey>& more) {
  keys.insert(keys.end(), more.begin(), more.end());
  return keys;
}

inline const JsonObjectKeys set = {
    "projections",
    joined(
        {{"schema", true, "\"ostium-measurement/2\"", json_type::constant("ostium-measurement/2")},
         {"kind", true, "\"projections\"", json_type::constant("projections")}},
        joined(keys_without(measurement_keys::set, {"schema", "source", "imaging", "experiments"}),
               {{"source", false, "who measured, how, under which licence, a text", json_type::text()},
                {"imaging", true, "how it was clicked, an object", json_type::object("imaging")},
                {"views", true, "the C-arm's views, not empty", json_type::list_of(json_type::object("view"), 1)},
                {"polylines_csv", false,
                 "in place of the experiments' projections: a table in the set's folder with the columns experiment, "
                 "view, column_px and row_px, points in order from base to tip",
                 json_type::text()},
                {"experiments", true, "experiments in the order in which they were done, not empty",
                 json_type::list_of(json_type::object("experiment"), 1)}}))};

inline const JsonObjectKeys imaging = {
    "imaging",
    {{"noise_sigma_px", true, "the noise of a clicked coordinate in px, 1e-3 or more, or null if it is unknown",
      json_type::null_or(json_type::number({.least = 1e-3}))},
     {"views", true, "\"given\": the views are where they are declared", json_type::choice({"given"})}}};

inline const JsonObjectKeys view = {
    "view",
    {{"id", true, "a name that no other view has, a text", json_type::text()},
     {"primary_deg", false,
      "the C-arm's primary angle in degrees, positive to the patient's left (LAO), -180 to 180; the frame's x goes to "
      "the patient's left, y to the back, z to the head",
      json_type::number(from_to(-180, 180))},
     {"secondary_deg", false, "its secondary angle in degrees, positive to the head (cranial), -90 to 90",
      json_type::number(from_to(-90, 90))},
     {"source_mm", false, "where the X-ray source is, three numbers in mm", json_type::numbers(3)},
     {"pixel_0_0_mm", false, "the centre of the pixel of column 0 and row 0, three numbers in mm",
      json_type::numbers(3)},
     {"u", false, "three numbers, a unit vector: towards higher columns", json_type::numbers(3)},
     {"v", false, "three numbers, a unit vector perpendicular to u: towards higher rows", json_type::numbers(3)},
     {"pixel_mm", false, "from one pixel to the next on the detector in mm, > 0", json_type::number(above_zero)},
     {"columns", false, "pixels in a row, a whole number, at least 2", json_type::whole(from_to(2, 100000))},
     {"rows", false, "pixels in a column, a whole number, at least 2", json_type::whole(from_to(2, 100000))},
     {"dicom", false,
      "in place of all these: a frame of this view, a file in the set's folder whose tags give angles, distances and "
      "pixels",
      json_type::text()},
     {"isocentre_mm", false, "with dicom: the isocentre in the set's frame, three numbers in mm; else the origin",
      json_type::numbers(3)}},
    {one_of_required({{"source_mm", "pixel_0_0_mm", "u", "v", "pixel_mm", "columns", "rows"}, {"dicom"}}),
     required_together("primary_deg", "secondary_deg")}};

inline const JsonObjectKeys experiment = {
    "experiment",
    joined(keys_without(measurement_keys::experiment, {"centreline_mm", "tip_mm", "radius_of_curvature_mm"}),
           {{"projections", false, "what each view saw, one object for each of them",
             json_type::list_of(json_type::object("projection"), 1)}})};

inline const JsonObjectKeys projection = {
    "projection",
    {{"view", true, "the id of a view, a text", json_type::text()},
     {"polyline_px", true, "at least two points of 2 numbers in px, [column, row], base to tip",
      json_type::list_of(json_type::numbers(2), 2)}}};

/// All of them; the file's own object comes first.
inline const std::vector<const JsonObjectKeys*> all = {&set,
                                                       &measurement_keys::instrument,
                                                       &measurement_keys::section,
                                                       &measurement_keys::environment,
                                                       &imaging,
                                                       &measurement_keys::vessel,
                                                       &view,
                                                       &measurement_keys::effect,
                                                       &experiment,
                                                       &measurement_keys::base,
                                                       &measurement_keys::placement,
                                                       &measurement_keys::specimen,
                                                       &projection};

}  // namespace ostium::data::projection_keys
