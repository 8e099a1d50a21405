#pragma once
/// The keys of a measured set, object by object: what the reader accepts, and what it says of each. The schema
/// (data/schemas/measurement.schema.json) has the same, which a test holds it to.
#include "data/formats/json_object.h"

namespace ostium::measurement_keys {

inline const JsonObjectKeys set = {
    "measurement",
    {{"schema", true, "\"ostium-measurement/1\""},
     {"title", true, "what was measured, a text"},
     {"source", true, "who measured, how, under which licence, a text"},
     {"instruments", true, "instruments, outermost first, not empty"},
     {"environment", true, "gravity and vessel, an object"},
     {"imaging", true, "how it was measured, an object"},
     {"effects", false, "effects that the model is to include, a list"},
     {"experiments", true, "experiments in the order in which they were done, not empty"}}};

inline const JsonObjectKeys instrument = {
    "instrument",
    {{"name", true, "what people call it, a text"},
     {"total_length_mm", true, "its length in mm, > 0"},
     {"outer_radius_mm", true, "its outer radius in mm, > 0"},
     {"inner_radius_mm", true, "its lumen's radius in mm, >= 0 and less than outer_radius_mm; 0: none"},
     {"sections", true, "sections from the distal tip backwards, without gaps, to total_length_mm"}}};

inline const JsonObjectKeys section = {
    "section",
    {{"from_tip_mm", true, "two distances from the distal tip in mm, [from, to], 0 <= from < to <= total_length_mm"},
     {"EI_Nmm2", true, "bending stiffness in N mm2, > 0"},
     {"GJ_Nmm2", true, "torsional stiffness in N mm2, > 0"},
     {"kg_per_mm", true, "weight in kg/mm, >= 0"},
     {"rest_curvature_per_mm", false, "two numbers in 1/mm, [k1, k2]: the Darboux vector at rest"}}};

inline const JsonObjectKeys environment = {
    "environment",
    {{"gravity_m_s2", true, "three numbers in m/s2"}, {"vessel", true, "null, or an object: the vessel it lay in"}}};

inline const JsonObjectKeys vessel = {"vessel",
                                      {{"mesh", true, "the mesh's file, in the set's folder, a text"},
                                       {"units", true, "the unit of the mesh"},
                                       {"friction", true, "the coefficient of friction, >= 0"}}};

inline const JsonObjectKeys imaging = {
    "imaging",
    {{"noise_sigma_mm", true, "the noise of a coordinate in mm, > 0, or null if it is unknown"},
     {"registration", true, "whether the measuring frame is known"},
     {"tip_offset", true, "whether the tracked point sits off the tip"}}};

inline const JsonObjectKeys effect = {"effect",
                                      {{"id", true, "the id of an effect, a text"},
                                       {"instrument", false, "the index of an instrument, or null: all it can act on"},
                                       {"parameters", true, "numbers by their names, an object"}}};

inline const JsonObjectKeys experiment = {
    "experiment",
    {{"id", true, "a name that no other experiment has, a text"},
     {"base", true, "where the instruments enter, an object"},
     {"set", true, "where the instruments are, one object for each of them"},
     {"specimen", false, "one for each instrument: null, or an object with this specimen's curvature"},
     {"tip_force_N", false, "three numbers in N: the load on the innermost tip"},
     {"proximal_force_N", false, "the push measured at the base in N, a number"},
     {"elapsed_s", false, "the time since the instruments took this position in s, >= 0"},
     {"group", false, "what experiments share, a text"},
     {"centreline_mm", false, "at least two points of 3 numbers in mm, base to tip"},
     {"tip_mm", false, "three numbers in mm"},
     {"radius_of_curvature_mm", false, "a radius in mm, > 0"}}};

inline const JsonObjectKeys base = {"base",
                                    {{"position_mm", true, "three numbers in mm"},
                                     {"tangent", true, "three numbers, not all zero: towards the tip"},
                                     {"up", true, "three numbers, not all zero and not along the tangent"}}};

inline const JsonObjectKeys placement = {
    "placement",
    {{"inserted_length_mm", true, "the length from the base to this instrument's tip in mm, > 0"},
     {"roll_deg", true, "the commanded roll in degrees, a number"},
     {"shaft_mm", false, "the straight shaft between drive and base in mm, >= 0"}}};

inline const JsonObjectKeys specimen = {"specimen", {{"rest_curvature_per_mm", true, "two numbers in 1/mm, [k1, k2]"}}};

/// All of them, for the test that compares them with the schema.
inline const std::vector<const JsonObjectKeys*> all = {&set,    &instrument, &section, &environment, &vessel,  &imaging,
                                                       &effect, &experiment, &base,    &placement,   &specimen};

}  // namespace ostium::measurement_keys
