#pragma once
/// The keys of an instrument file, object by object: what the reader accepts, and how each is described. The schema
/// (data/schemas/instrument.schema.json) is generated from them.
#include <fmt/format.h>

#include <type_traits>

#include "data/catalogue/instrument/instrument.h"
#include "data/catalogue/instrument/instrument_design.h"
#include "data/formats/json/json_object.h"

namespace ostium::data::instrument_keys {

inline const std::string source_text = "where the numbers are from: a citation, or \"estimate: \" and the reasoning";
inline const std::string stretch_text =
    "two distances from the tip in mm, [from, to], 0 <= from < to <= length, one stretch after the other";

inline const JsonObjectKeys instrument = {
    "instrument",
    {{"schema", true, "\"ostium-instrument/1\"", json_type::constant("ostium-instrument/1")},
     {"name", true, "the file's name without .json", json_type::text()},
     {"title", true, "the name that people use, a text", json_type::text()},
     {"kind", true, "the kind of instrument", json_type::choice(instrument_kinds())},
     {"size", true, "diameters and length, an object", json_type::object("size")},
     {"sections", true, "stiffness and weight, an object", json_type::object("sections")},
     {"radiopacity", true, "what an X-ray shows, an object", json_type::object("radiopacity")},
     {"shape", false, "the preformed shape, an object; only without rest_curvature_per_mm and shapeable_tip",
      json_type::object("shape")},
     {"shapeable_tip", false, "the stretch that can be bent, an object; for wires only",
      json_type::object("shapeable_tip")},
     {"markers", false, "radiopaque bands, an object", json_type::object("markers")},
     {"wire_lumen", false, "how it runs over its wire, an object; for balloon_shaft and stent_shaft, which need it",
      json_type::object("wire_lumen")},
     {"balloon", false, "what it carries, an object; for balloon_shaft and stent_shaft, which need it",
      json_type::object("balloon")},
     {"stent", false, "what is crimped on the balloon, an object; for stent_shaft, which needs it",
      json_type::object("stent")},
     {"clearance", false, "what goes through it and what it goes through, an object", json_type::object("clearance")},
     {"friction", false, "its friction on the benches that measured it, an object; a session has the vessel's own",
      json_type::object("friction")}}};

inline const JsonObjectKeys friction = {
    "friction",
    {{"coefficient", true, "the coefficient of friction, > 0 and at most 2", json_type::number(above_zero_to(2))},
     {"sigma", true, "its standard error, > 0", json_type::number(above_zero)},
     {"source", true, source_text, json_type::text()}}};

inline const JsonObjectKeys size = {
    "size",
    {{"outer_diameter_mm", true, "the largest outer diameter in mm, > 0", json_type::number(above_zero)},
     {"inner_diameter_mm", true, "the lumen's diameter in mm, >= 0 and less than the outer one; 0 for a wire only",
      json_type::number(from_zero)},
     {"length_mm", true, "the usable length in mm, > 0", json_type::number(above_zero)},
     {"source", true, source_text, json_type::text()}}};

inline const JsonObjectKeys sections = {
    "sections",
    {{"list", true, "sections from the tip backwards, not empty", json_type::list_of(json_type::object("section"), 1)},
     {"relaxation", false, "one or two branches of what the material gives up with time, less than 1 together",
      json_type::list_of(json_type::object("relaxation"), 1, 2)},
     {"source", true, source_text, json_type::text()}}};

inline const JsonObjectKeys relaxation_branch = {
    "relaxation",
    {{"fraction", true, "the part of its moment that it gives up when it is held, above 0 and less than 1 in all",
      json_type::number(JsonRange{.above = 0, .below = 1})},
     {"time_s", true, "the time constant in s, > 0", json_type::number(above_zero)}}};

inline const JsonObjectKeys section = {
    "section",
    {{"from_tip_mm", true, stretch_text, json_type::numbers(2, from_zero)},
     {"EI_Nmm2", false,
      "bending stiffness in N mm2, > 0, at most diamond's in its cross-section, if it is the same about both axes",
      json_type::number(above_zero)},
     {"EI1_Nmm2", false, "bending stiffness about d1 in N mm2, > 0, at most diamond's; with EI2_Nmm2, without EI_Nmm2",
      json_type::number(above_zero)},
     {"EI2_Nmm2", false, "bending stiffness about d2 in N mm2, > 0, at most diamond's; with EI1_Nmm2, without EI_Nmm2",
      json_type::number(above_zero)},
     {"GJ_Nmm2", true, "torsional stiffness in N mm2, > 0, at most diamond's", json_type::number(above_zero)},
     {"kg_per_m", true, "weight in kg/m, > 0, at most osmium's in its cross-section", json_type::number(above_zero)},
     {"EI_sigma_Nmm2", false, "the standard error of the bending stiffness in N mm2, > 0, if it was measured",
      json_type::number(above_zero)},
     {"GJ_sigma_Nmm2", false, "the standard error of the torsional stiffness in N mm2, > 0, if it was measured",
      json_type::number(above_zero)},
     {"outer_diameter_mm", false, "this section's outer diameter in mm, > 0 and at most size.outer_diameter_mm",
      json_type::number(above_zero)},
     {"inner_diameter_mm", false, "this section's inner diameter in mm, >= 0 and less than its outer one",
      json_type::number(from_zero)},
     {"rest_curvature_per_mm", false, "three numbers in 1/mm, [k1, k2, k3]: the Darboux vector at rest",
      json_type::numbers(3)},
     {"softening_per_mm", false, "the curvature beyond rest at which bending softens in 1/mm, > 0; with softened_ratio",
      json_type::number(above_zero)},
     {"softened_ratio", false, "stiffness far beyond it against that below it, 0.01 to 1; with softening_per_mm",
      json_type::number(from_to(0.01, 1))},
     {"moment_curvature", false, "bending that is not linear, by its tangent; without softening",
      json_type::object("moment_curvature")},
     {"source", false, source_text, json_type::text()}},
    {one_of_required({{"EI_Nmm2"}, {"EI1_Nmm2", "EI2_Nmm2"}})}};

inline const JsonObjectKeys moment_curvature = {
    "moment_curvature",
    {{"curvature_per_mm", true,
      "curvatures beyond rest in 1/mm, > 0, rising, the same in all sections that have them; at most 12",
      json_type::list_of(json_type::number(above_zero), 1)},
     {"tangent", true,
      "tangent stiffness there against EI, 0.01 to 100; straight between, 1 at no curvature, constant "
      "beyond the last",
      json_type::list_of(json_type::number(from_to(0.01, 100)), 1)}}};

inline const JsonObjectKeys shape = {
    "shape",
    {{"pieces", true, "pieces from the tip backwards, not empty and not longer than the instrument",
      json_type::list_of(json_type::object("piece"), 1)},
     {"width_mm", false, "from the shaft to the tip in mm, > 0, by which a guide is chosen for an aorta",
      json_type::number(above_zero)},
     {"source", true, source_text, json_type::text()}}};

inline const JsonObjectKeys piece = {
    "piece",
    {{"name", false, "what people call it, a text", json_type::text()},
     {"length_mm", true, "the piece's length along the centreline in mm, > 0", json_type::number(above_zero)},
     {"radius_mm", false,
      "the arc's radius in mm, at least half the outer diameter, together with plane_deg; neither for a straight piece",
      json_type::number(above_zero)},
     {"plane_deg", false, "the side it bends to in degrees, -360 to 360: 0 to d1, 90 to d2; together with radius_mm",
      json_type::number(from_to(-360, 360))}},
    {required_together("radius_mm", "plane_deg"),
     {"description",
      json_text("of the shape at rest, from the tip backwards: straight, or an arc with radius and plane")}}};

inline const JsonObjectKeys shapeable_tip = {
    "shapeable_tip",
    {{"length_mm", true, "the stretch from the tip that can be bent in mm, > 0 and at most the length",
      json_type::number(above_zero)},
     {"pieces", true, "its default shape: pieces from the tip backwards, not longer than the stretch",
      json_type::list_of(json_type::object("piece"), 1)},
     {"source", true, source_text, json_type::text()}},
    {{"description", json_text("of a wire without preformed shape: what the operator can bend, and how it comes")}}};

inline const JsonObjectKeys radiopacity = {
    "radiopacity",
    {{"list", true, "stretches from the tip to the whole length", json_type::list_of(json_type::object("stretch"), 1)},
     {"source", true, source_text, json_type::text()}}};

inline const JsonObjectKeys stretch = {
    "stretch",
    {{"from_tip_mm", true, stretch_text, json_type::numbers(2, from_zero)},
     {"material", true, "what absorbs X-rays", json_type::choice(opaque_materials())},
     {"thickness_mm", true, "its cross-section divided by the outer diameter, in mm, >= 0, at most pi/4 of that",
      json_type::number(from_zero)},
     {"source", false, source_text, json_type::text()}}};

inline const JsonObjectKeys markers = {
    "markers",
    {{"list", true, "bands, a list", json_type::list_of(json_type::object("marker"))},
     {"source", true, source_text, json_type::text()}}};

inline const JsonObjectKeys marker = {
    "marker",
    {{"from_tip_mm", true, "the distance of its distal edge from the tip in mm, >= 0", json_type::number(from_zero)},
     {"length_mm", true, "the band's length in mm, > 0, its end within the instrument", json_type::number(above_zero)},
     {"material", true, "what absorbs X-rays", json_type::choice(opaque_materials())},
     {"thickness_mm", true, "the band's cross-section divided by its outer diameter, in mm, > 0",
      json_type::number(above_zero)},
     {"outer_diameter_mm", false,
      "the band's, where it is narrower than the instrument, in mm, > 0; then it is solid, and its thickness at most "
      "pi/4 of that",
      json_type::number(above_zero)},
     {"source", false, source_text, json_type::text()}}};

inline const JsonObjectKeys wire_lumen = {
    "wire_lumen",
    {{"system", true, "how it is exchanged", json_type::choice({"rapid_exchange", "over_the_wire"})},
     {"length_mm", false, "from the tip to the wire's port in mm, > 0 and at most the length; for rapid_exchange only",
      json_type::number(above_zero)},
     {"source", true, source_text, json_type::text()}},
    {{"description", json_text("of balloon and stent shafts, which need it")}}};

/// The keys of a design block come from the rows of its tables; all are optional except the source.
template <class... Tables>
JsonObjectKeys design_keys(const char* object, const Tables&... tables) {
  JsonObjectKeys out{object, {}};
  const auto add = [&](const auto& table) {
    for (const auto& row : table) {
      const auto range = from_to(1.0 * row.least, 1.0 * row.most);
      out.keys.push_back(
          {row.key, false, fmt::format("{}, {:g} to {:g}", row.text, 1.0 * row.least, 1.0 * row.most),
           std::is_integral_v<decltype(row.least)> ? json_type::whole(range) : json_type::number(range)});
    }
  };
  (add(tables), ...);
  out.keys.push_back({"source", true, source_text, json_type::text()});
  return out;
}

inline const JsonObjectKeys balloon_design = design_keys("balloon_design", balloon_design_numbers);
inline const JsonObjectKeys stent_design = design_keys("stent_design", stent_design_counts, stent_design_numbers);

inline const JsonObjectKeys balloon = {
    "balloon",
    {{"nominal_diameter_mm", true, "its diameter at the nominal pressure in mm, 1 to 8",
      json_type::number(from_to(1, 8))},
     {"length_mm", true, "between the middles of both markers in mm, 5 to 60, as the markers say",
      json_type::number(from_to(5, 60))},
     {"compliance", true, "how it grows", json_type::choice({"semi", "non"})},
     {"nominal_atm", true, "the nominal pressure in atm, > 0", json_type::number(above_zero)},
     {"rated_atm", true, "the rated burst pressure in atm, at least the nominal one and at most 30",
      json_type::number(above_zero_to(30))},
     {"design", false, "how it is made, where it differs from a common one, an object",
      json_type::object("balloon_design")},
     {"source", true, source_text, json_type::text()}},
    {{"description", json_text("what balloon and stent shafts carry, which need it")}}};

inline const JsonObjectKeys stent = {
    "stent",
    {{"nominal_diameter_mm", true, "its diameter, open, in mm, 1 to 8", json_type::number(from_to(1, 8))},
     {"length_mm", true, "crimped, in mm, 5 to 60 and at most that of its balloon", json_type::number(from_to(5, 60))},
     {"design", false, "how it is made, where it differs from a common one, an object",
      json_type::object("stent_design")},
     {"source", true, source_text, json_type::text()}},
    {{"description", json_text("crimped on the balloon of a stent shaft, which needs it")}}};

inline const JsonObjectKeys clearance = {
    "clearance",
    {{"passes_mm", false, "the largest diameter that goes through it in mm, > 0 and at most the inner diameter",
      json_type::number(above_zero)},
     {"needs_mm", false, "the smallest lumen that it goes through in mm, at least the outer diameter",
      json_type::number(above_zero)},
     {"source", true, source_text, json_type::text()}},
    {at_least_properties(2)}};

/// All of them; the file's own object comes first.
inline const std::vector<const JsonObjectKeys*> all = {
    &instrument, &size,           &sections,    &relaxation_branch, &section,   &moment_curvature, &shape,
    &piece,      &shapeable_tip,  &radiopacity, &stretch,           &markers,   &marker,           &wire_lumen,
    &balloon,    &balloon_design, &stent,       &stent_design,      &clearance, &friction};

}  // namespace ostium::data::instrument_keys
