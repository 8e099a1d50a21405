#pragma once
/// The keys of an instrument file, object by object: what the reader accepts, and what it says of each. The schema
/// (data/schemas/instrument.schema.json) has the same, which a test holds it to.
#include "data/formats/json_object.h"
#include "data/instrument_design.h"
#include <fmt/format.h>

namespace ostium::instrument_keys {

inline const std::string source_text = "where the numbers are from: a citation, or \"estimate: \" and the reasoning";
inline const std::string stretch_text =
    "two distances from the tip in mm, [from, to], 0 <= from < to <= length, one stretch after the other";

inline const JsonObjectKeys instrument = {
    "instrument",
    {{"schema", true, "\"ostium-instrument/1\""},
     {"name", true, "the file's name without .json"},
     {"title", true, "the name that people use, a text"},
     {"kind", true, "the kind of instrument"},
     {"size", true, "diameters and length, an object"},
     {"sections", true, "stiffness and weight, an object"},
     {"radiopacity", true, "what an X-ray shows, an object"},
     {"shape", false, "the preformed shape, an object; only without rest_curvature_per_mm and shapeable_tip"},
     {"shapeable_tip", false, "the stretch that can be bent, an object; for wires only"},
     {"markers", false, "radiopaque bands, an object"},
     {"wire_lumen", false, "how it runs over its wire, an object; for balloon_shaft and stent_shaft, which need it"},
     {"balloon", false, "what it carries, an object; for balloon_shaft and stent_shaft, which need it"},
     {"stent", false, "what is crimped on the balloon, an object; for stent_shaft, which needs it"},
     {"clearance", false, "what goes through it and what it goes through, an object"}}};

inline const JsonObjectKeys size = {
    "size",
    {{"outer_diameter_mm", true, "the largest outer diameter in mm, > 0"},
     {"inner_diameter_mm", true, "the lumen's diameter in mm, >= 0 and less than the outer one; 0 for a wire only"},
     {"length_mm", true, "the usable length in mm, > 0"},
     {"source", true, source_text}}};

inline const JsonObjectKeys sections = {
    "sections",
    {{"list", true, "sections from the tip backwards, not empty"},
     {"relaxation", false, "one or two branches of what the material gives up with time, less than 1 together"},
     {"source", true, source_text}}};

inline const JsonObjectKeys relaxation_branch = {
    "relaxation",
    {{"fraction", true, "the part of its moment that it gives up when it is held, above 0 and less than 1 in all"},
     {"time_s", true, "the time constant in s, > 0"}}};

inline const JsonObjectKeys section = {
    "section",
    {{"from_tip_mm", true, stretch_text},
     {"EI_Nmm2", false, "bending stiffness in N mm2, > 0, if it is the same about both axes"},
     {"EI1_Nmm2", false, "bending stiffness about d1 in N mm2, > 0; with EI2_Nmm2, without EI_Nmm2"},
     {"EI2_Nmm2", false, "bending stiffness about d2 in N mm2, > 0; with EI1_Nmm2, without EI_Nmm2"},
     {"GJ_Nmm2", true, "torsional stiffness in N mm2, > 0"},
     {"kg_per_m", true, "weight in kg/m, > 0"},
     {"outer_diameter_mm", false, "this section's outer diameter in mm, > 0 and at most size.outer_diameter_mm"},
     {"inner_diameter_mm", false, "this section's inner diameter in mm, >= 0 and less than its outer one"},
     {"rest_curvature_per_mm", false, "three numbers in 1/mm, [k1, k2, k3]: the Darboux vector at rest"},
     {"softening_per_mm", false,
      "the curvature beyond rest at which bending softens in 1/mm, > 0; with softened_ratio"},
     {"softened_ratio", false, "stiffness far beyond it against that below it, 0.01 to 1; with softening_per_mm"},
     {"source", false, source_text}}};

inline const JsonObjectKeys shape = {
    "shape",
    {{"pieces", true, "pieces from the tip backwards, not empty and not longer than the instrument"},
     {"width_mm", false, "from the shaft to the tip in mm, > 0, by which a guide is chosen for an aorta"},
     {"source", true, source_text}}};

inline const JsonObjectKeys piece = {
    "piece",
    {{"name", false, "what people call it, a text"},
     {"length_mm", true, "the piece's length along the centreline in mm, > 0"},
     {"radius_mm", false, "the arc's radius in mm, > 0, together with plane_deg; neither for a straight piece"},
     {"plane_deg", false, "the side it bends to in degrees, 0 to d1, 90 to d2; together with radius_mm"}}};

inline const JsonObjectKeys shapeable_tip = {
    "shapeable_tip",
    {{"length_mm", true, "the stretch from the tip that can be bent in mm, > 0 and at most the length"},
     {"pieces", true, "its default shape: pieces from the tip backwards, not longer than the stretch"},
     {"source", true, source_text}}};

inline const JsonObjectKeys radiopacity = {
    "radiopacity", {{"list", true, "stretches from the tip to the whole length"}, {"source", true, source_text}}};

inline const JsonObjectKeys stretch = {
    "stretch",
    {{"from_tip_mm", true, stretch_text},
     {"material", true, "what absorbs X-rays"},
     {"thickness_mm", true, "its cross-section divided by the outer diameter, in mm, >= 0"},
     {"source", false, source_text}}};

inline const JsonObjectKeys markers = {"markers", {{"list", true, "bands, a list"}, {"source", true, source_text}}};

inline const JsonObjectKeys marker = {
    "marker",
    {{"from_tip_mm", true, "the distance of its distal edge from the tip in mm, >= 0"},
     {"length_mm", true, "the band's length in mm, > 0, its end within the instrument"},
     {"material", true, "what absorbs X-rays"},
     {"thickness_mm", true, "the band's cross-section divided by the outer diameter, in mm, > 0"},
     {"source", false, source_text}}};

inline const JsonObjectKeys wire_lumen = {
    "wire_lumen",
    {{"system", true, "how it is exchanged"},
     {"length_mm", false, "from the tip to the wire's port in mm, > 0 and at most the length; for rapid_exchange only"},
     {"source", true, source_text}}};

/// The keys of a design are the rows of its tables; none must be there, but the source must.
template <class... Tables>
JsonObjectKeys design_keys(const char* object, const Tables&... tables) {
  JsonObjectKeys out{object, {}};
  const auto add = [&](const auto& table) {
    for (const auto& row : table)
      out.keys.push_back({row.key, false, fmt::format("{}, {:g} to {:g}", row.text, 1.0 * row.least, 1.0 * row.most)});
  };
  (add(tables), ...);
  out.keys.push_back({"source", true, source_text});
  return out;
}

inline const JsonObjectKeys balloon_design = design_keys("balloon_design", balloon_design_numbers);
inline const JsonObjectKeys stent_design = design_keys("stent_design", stent_design_counts, stent_design_numbers);

inline const JsonObjectKeys balloon = {
    "balloon",
    {{"nominal_diameter_mm", true, "its diameter at the nominal pressure in mm, 1 to 8"},
     {"length_mm", true, "between the middles of both markers in mm, 5 to 60, as the markers say"},
     {"compliance", true, "how it grows"},
     {"nominal_atm", true, "the nominal pressure in atm, > 0"},
     {"rated_atm", true, "the rated burst pressure in atm, at least the nominal one and at most 30"},
     {"design", false, "how it is made, where it differs from a common one, an object"},
     {"source", true, source_text}}};

inline const JsonObjectKeys stent = {
    "stent",
    {{"nominal_diameter_mm", true, "its diameter, open, in mm, 1 to 8"},
     {"length_mm", true, "crimped, in mm, 5 to 60 and at most that of its balloon"},
     {"design", false, "how it is made, where it differs from a common one, an object"},
     {"source", true, source_text}}};

inline const JsonObjectKeys clearance = {
    "clearance",
    {{"passes_mm", false, "the largest diameter that goes through it in mm, > 0 and at most the inner diameter"},
     {"needs_mm", false, "the smallest lumen that it goes through in mm, at least the outer diameter"},
     {"source", true, source_text}}};

/// All of them, for the test that compares them with the schema.
inline const std::vector<const JsonObjectKeys*> all = {
    &instrument, &size,   &sections,   &section, &shape,          &piece, &shapeable_tip, &radiopacity, &stretch,
    &markers,    &marker, &wire_lumen, &balloon, &balloon_design, &stent, &stent_design,  &clearance};

}  // namespace ostium::instrument_keys
