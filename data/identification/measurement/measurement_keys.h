#pragma once
/// The keys of a measured set, object by object: what the reader accepts, and how each is described. The schema
/// (data/schemas/measurement.schema.json) is generated from them.
#include "data/formats/json/json_object.h"

namespace ostium::data::measurement_keys {

inline const JsonObjectKeys set = {
    "measurement",
    {{"schema", true, "\"ostium-measurement/1\"", json_type::constant("ostium-measurement/1")},
     {"title", true, "what was measured, a text", json_type::text()},
     {"source", true, "who measured, how, under which licence, a text", json_type::text()},
     {"instruments", true, "instruments, outermost first, not empty",
      json_type::list_of(json_type::object("instrument"), 1)},
     {"environment", true, "gravity and vessel, an object", json_type::object("environment")},
     {"imaging", true, "how it was measured, an object", json_type::object("imaging")},
     {"effects", false, "effects that the model is to include, a list",
      json_type::list_of(json_type::object("effect"))},
     {"experiments", true, "experiments in the order in which they were done, not empty",
      json_type::list_of(json_type::object("experiment"), 1)}}};

inline const JsonObjectKeys instrument = {
    "instrument",
    {{"name", true, "what people call it, a text", json_type::text()},
     {"total_length_mm", true, "its length in mm, > 0", json_type::number(above_zero)},
     {"outer_radius_mm", true, "its outer radius in mm, > 0", json_type::number(above_zero)},
     {"inner_radius_mm", true, "its lumen's radius in mm, >= 0 and less than outer_radius_mm; 0: none",
      json_type::number(from_zero)},
     {"sections", true, "sections from the distal tip backwards, without gaps, to total_length_mm",
      json_type::list_of(json_type::object("section"), 1)}}};

inline const JsonObjectKeys section = {
    "section",
    {{"from_tip_mm", true, "two distances from the distal tip in mm, [from, to], 0 <= from < to <= total_length_mm",
      json_type::numbers(2)},
     {"EI_Nmm2", true, "bending stiffness in N mm2, > 0", json_type::number(above_zero)},
     {"GJ_Nmm2", true, "torsional stiffness in N mm2, > 0", json_type::number(above_zero)},
     {"kg_per_mm", true, "weight in kg/mm, >= 0", json_type::number(from_zero)},
     {"rest_curvature_per_mm", false, "two numbers in 1/mm, [k1, k2]: the Darboux vector at rest",
      json_type::numbers(2)}}};

inline const JsonObjectKeys environment = {
    "environment",
    {{"gravity_m_s2", true, "three numbers in m/s2", json_type::numbers(3)},
     {"vessel", true, "null, or an object: the vessel it lay in", json_type::null_or(json_type::object("vessel"))}}};

inline const JsonObjectKeys vessel = {
    "vessel",
    {{"mesh", true, "the mesh's file, in the set's folder, a text", json_type::text()},
     {"units", true, "the unit of the mesh", json_type::choice({"mm", "cm", "m", "in"})},
     {"friction", true, "the coefficient of friction, 0 to 2", json_type::number(from_to(0, 2))}}};

inline const JsonObjectKeys imaging = {
    "imaging",
    {{"noise_sigma_mm", true, "the noise of a coordinate in mm, 1e-6 or more, or null if it is unknown",
      json_type::null_or(json_type::number({.least = 1e-6}))},
     {"registration", true, "whether the measuring frame is known", json_type::choice({"given", "free"})},
     {"tip_offset", true, "whether the tracked point sits off the tip", json_type::choice({"none", "free"})}}};

inline const JsonObjectKeys effect = {
    "effect",
    {{"id", true, "the id of an effect, a text", json_type::text()},
     {"instrument", false, "the index of an instrument, or null: all it can act on",
      json_type::null_or(json_type::whole(from_zero))},
     {"parameters", true, "numbers by their names, an object", json_type::values_by_name({json_type::number()})}}};

inline const JsonObjectKeys experiment = {
    "experiment",
    {{"id", true, "a name that no other experiment has, a text", json_type::text()},
     {"base", true, "where the instruments enter, an object", json_type::object("base")},
     {"set", true, "where the instruments are, one object for each of them",
      json_type::list_of(json_type::object("placement"), 1)},
     {"specimen", false, "one for each instrument: null, or an object with this specimen's curvature",
      json_type::list_of(json_type::null_or(json_type::object("specimen")), 1)},
     {"tip_force_N", false, "three numbers in N: the load on the innermost tip", json_type::numbers(3)},
     {"proximal_force_N", false, "the push measured at the base in N, a number", json_type::number()},
     {"elapsed_s", false, "the time since the instruments took this position in s, >= 0", json_type::number(from_zero)},
     {"group", false, "what experiments share, a text", json_type::text()},
     {"centreline_mm", false, "at least two points of 3 numbers in mm, base to tip",
      json_type::list_of(json_type::numbers(3), 2)},
     {"tip_mm", false, "three numbers in mm", json_type::numbers(3)},
     {"radius_of_curvature_mm", false, "a radius in mm, > 0", json_type::number(above_zero)}},
    {one_of_required({{"centreline_mm"}, {"tip_mm"}, {"radius_of_curvature_mm"}})}};

inline const JsonObjectKeys base = {
    "base",
    {{"position_mm", true, "three numbers in mm", json_type::numbers(3)},
     {"tangent", true, "three numbers, not all zero: towards the tip", json_type::numbers(3)},
     {"up", true, "three numbers, not all zero and not along the tangent", json_type::numbers(3)}}};

inline const JsonObjectKeys placement = {
    "placement",
    {{"inserted_length_mm", true, "the length from the base to this instrument's tip in mm, > 0",
      json_type::number(above_zero)},
     {"roll_deg", true, "the commanded roll in degrees, a number", json_type::number()},
     {"shaft_mm", false, "the straight shaft between drive and base in mm, >= 0", json_type::number(from_zero)}}};

inline const JsonObjectKeys specimen = {
    "specimen", {{"rest_curvature_per_mm", true, "two numbers in 1/mm, [k1, k2]", json_type::numbers(2)}}};

/// All of them; the file's own object comes first.
inline const std::vector<const JsonObjectKeys*> all = {&set,    &instrument, &section, &environment, &vessel,  &imaging,
                                                       &effect, &experiment, &base,    &placement,   &specimen};

}  // namespace ostium::data::measurement_keys
