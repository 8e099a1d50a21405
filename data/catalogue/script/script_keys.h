#pragma once
/// The keys of a script, object by object: what the reader accepts, and how each is described. The schema
/// (data/schemas/script.schema.json) is generated from them.
#include "data/catalogue/case/case.h"
#include "data/catalogue/script/script_actions.h"
#include "data/catalogue/script/script_condition_reader.h"
#include "data/formats/json/json_object.h"
#include "vascular/treatment/treatment.h"

namespace ostium::data::script_keys {

/// All but "nothing".
inline std::vector<std::string> complication_names() {
  return {std::begin(vascular::provocation_names) + 1, std::end(vascular::provocation_names)};
}

inline const JsonObjectKeys root = {
    "script",
    {{"schema", true, "\"ostium-script/1\"", json_type::constant("ostium-script/1")},
     {"name", true, "what tables and reports call it; a script of the catalogue has its file's name",
      json_type::text()},
     {"title", true, "what people call it, a text", json_type::text()},
     {"access", false, "where it comes in, as a case says it; if not said, anywhere",
      json_type::choice(access_names())},
     {"lesions_in", false, "arteries in each of which it treats a lesion, a list: \"LAD\"; other cases are refused",
      json_type::list_of(json_type::text(), 1)},
     {"tools", true, "what is used, the outermost first, a list of at least one",
      json_type::list_of(json_type::object("tool"), 1)},
     {"values", false,
      "what may be said anew where its steps stand in another script, an object: numbers, texts, true or false, each "
      "as it is if nothing is said; \"$NAME\" stands for it in steps",
      json_type::values_by_name({json_type::number(), json_type::boolean(), json_type::text()})},
     {"landmarks", false, "points of one's own, a list", json_type::list_of(json_type::object("landmark"))},
     {"steps", true, "what the operator does, in order, a list of at least one",
      json_type::list_of(json_type::object("step"), 1)}}};

inline const JsonObjectKeys tool = {
    "tool",
    {{"name", true, "what the script calls it: \"wire\"", json_type::text()},
     {"instrument", true, "a name of `ostium instruments`, or a file, looked for from the script's folder",
      json_type::text()},
     {"sizes", false, "balloons or stents to choose from by the artery, or guides by the aorta, a list of such names",
      json_type::list_of(json_type::text(), 1)},
     {"of_reference", false,
      "their nominal diameter at most, over the healthy artery's beside the "
      "lesion, > 0 and at most 1.5; beside sizes",
      json_type::number(above_zero_to(1.5))},
     {"of_aorta", false,
      "a guide's width at most, over the ascending aorta's diameter, > 0 and at most 3; beside sizes, instead of "
      "of_reference",
      json_type::number(above_zero_to(3))},
     {"lesion", false,
      "which of the case's lesions, a whole number from 1 on; the first if it is not said; beside sizes and "
      "of_reference",
      json_type::whole(from_to(1, 100))},
     {"over", false, "of several wires that go through it, the tool that it runs over", json_type::text()}}};

inline const JsonObjectKeys landmark = {
    "landmark",
    {{"name", true, "what the script calls it", json_type::text()},
     {"at_mm", true, "a point of the patient frame in mm, three numbers from -3000 to 3000: left, head, front",
      json_type::numbers(3, from_to(-3000, 3000))}}};

inline const JsonObjectKeys step = {
    "step",
    {{"do", true, "what is done", json_type::choice(action_names())},
     {"script", false,
      "the name of a script without .json, as seen from this one's folder: its steps stand here, with this script's "
      "tools",
      json_type::text()},
     {"with", false, "beside script: what its tools are called here, an object of names",
      json_type::values_by_name({json_type::text()})},
     {"values", false, "beside script: its values that differ from those that it has itself, an object",
      json_type::values_by_name({json_type::number(), json_type::boolean(), json_type::text()})},
     {"when", false, "\"$NAME\": the step stands there only where that value is true",
      json_type::either({json_type::boolean(), json_type::text()})},
     {"when_not", false, "\"$NAME\": the step stands there only where that value is false",
      json_type::either({json_type::boolean(), json_type::text()})},
     {"lesion", false,
      "beside script: where its conditions are about a lesion and do not say which, a whole number from 1 on",
      json_type::whole(from_to(1, 100))},
     {"label", false,
      "a name of its own, for messages and for \"otherwise\"; beside script: what stands before the labels of its "
      "steps",
      json_type::text()},
     {"tool", false, "the name of a tool, or a list of those that are moved together",
      json_type::either({json_type::text(), json_type::list_of(json_type::text(), 1)})},
     {"speed_mm_s", false, "how fast, in mm/s, > 0 and at most 500", json_type::number(above_zero_to(500))},
     {"turn_deg_s", false,
      "how fast it is turned, in degrees/s, not 0, at most 3600; clockwise from behind is positive",
      json_type::number(from_to(-3600, 3600))},
     {"until", false, "a list of conditions; the first that holds ends the step",
      json_type::list_of(json_type::object("condition"), 1)},
     {"unless", false, "a list of conditions; if one of them holds first, the step has failed",
      json_type::list_of(json_type::object("condition"), 1)},
     {"timeout_s", false, "after this many seconds the step has failed, > 0 and at most 3600",
      json_type::number(above_zero_to(3600))},
     {"otherwise", false,
      "what a failure leads to: \"fail\" (if it is not said), \"go on\" or the label of a step; beside script: the "
      "label that its steps lead to where the run would end",
      json_type::text()},
     {"tries", false,
      "how often \"otherwise\" leads to that step, a whole number, 1 to 100, 1 if it is not said; then it is a "
      "failure",
      json_type::whole(from_to(1, 100))},
     {"last_resort", false,
      "the label of a step, beside otherwise: when tries are used up it is gone to, once, and there are as many again",
      json_type::text()},
     {"detour", false,
      "true: only another step's \"otherwise\" or \"last_resort\" leads to it, or a detour before it; what goes on "
      "from elsewhere goes past it. Not the first step",
      json_type::boolean()},
     {"view", false, "a name of `ostium views`", json_type::text()},
     {"lao_deg", false, "the C-arm's angle in degrees, -120 to 120; negative: RAO",
      json_type::number(from_to(-120, 120))},
     {"cran_deg", false, "the C-arm's angle in degrees, -55 to 55; negative: caudal",
      json_type::number(from_to(-55, 55))},
     {"table_mm", false, "the isocentre in the patient in mm, three numbers from -1000 to 1000: left, head, front",
      json_type::numbers(3, from_to(-1000, 1000))},
     {"field_mm", false, "side of the detector's field in mm: 200, 160 or 130",
      json_type::one_of_numbers({200, 160, 130})},
     {"on", false, "true or false", json_type::boolean()},
     {"rate_1_min", false, "beats, or compressions of the chest, a minute, 40 to 180",
      json_type::number(from_to(40, 180))},
     {"text", false, "what the report says of the moment that is marked; its label, if it is not said",
      json_type::text()},
     {"rate_mL_s", false, "how fast the thumb pushes, or draws, in mL/s, > 0 and at most 20",
      json_type::number(above_zero_to(20))},
     {"volume_mL", false, "how much, in mL, > 0 and at most 60; of fluid and of a drain, at most 1000",
      json_type::number(above_zero_to(1000))},
     {"iodine_mg_mL", false, "of what is in the syringe, 0 (saline) to 400; 350 if it is not said",
      json_type::number(from_to(0, 400))},
     {"gauge_atm", false, "pressure at the inflation device in atm, 0 to 30", json_type::number(from_to(0, 30))},
     {"over_s", false, "in how many seconds that is reached, > 0 and at most 60", json_type::number(above_zero_to(60))},
     {"heparin_U", false, "dose, > 0 and at most 20000", json_type::number(above_zero_to(20000))},
     {"nitrate_ug", false, "dose, into the coronary, > 0 and at most 1000", json_type::number(above_zero_to(1000))},
     {"adenosine_ug", false, "dose, into the coronary, > 0 and at most 1000", json_type::number(above_zero_to(1000))},
     {"drug", false, "a name of data/drugs", json_type::text()},
     {"dose_ug", false, "dose, > 0; the drug's file has its limits", json_type::number(above_zero_to(10000))},
     {"dose_mg", false, "dose, > 0; the drug's file has its limits", json_type::number(above_zero_to(1000))},
     {"current_mA", false, "of a pacemaker, 0 (off) to 20; usually it is followed from 0.3 to 0.7 on",
      json_type::number(from_to(0, 20))},
     {"hold", false, "a breath, drawn in or out first; without it, breathing goes on",
      json_type::choice({"in", "out"})},
     {"energy_J", false, "of a defibrillator, 1 to 360", json_type::number(from_to(1, 360))},
     {"complication", false, "what a trainer provokes", json_type::choice(complication_names())},
     {"at", false, "where: millimetres beyond the origin of a coronary branch, as RCA+40", json_type::text()},
     {"hole_mm", false, "diameter of a perforation, 0.1 to 2; 0.8 if it is not said",
      json_type::number(from_to(0.1, 2))},
     {"grade", false, "of a dissection", json_type::choice({"A", "B", "C", "D", "E", "F"})},
     {"share", false,
      "of the diameter that spasm takes, of the muscle that no-reflow closes, of the strongest vagal reaction; 0.1 to "
      "0.98",
      json_type::number(from_to(0.1, 0.98))},
     {"clot_mm3", false, "of a thrombus, 1 to 200; 25 if it is not said", json_type::number(from_to(1, 200))},
     {"air_mL", false, "of air in the line, 0.05 to 5; 0.5 if it is not said", json_type::number(from_to(0.05, 5))}},
    {},
    true};

/// Generated from the rows of script_conditions.h.
inline const JsonObjectKeys condition = condition_keys();

inline const std::vector<const JsonObjectKeys*> all = {&root, &tool, &landmark, &step, &condition};

}  // namespace ostium::data::script_keys
