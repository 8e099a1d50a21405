#pragma once
/// The keys of a script, object by object: what the reader accepts, and what it says of each. The schema
/// (data/schemas/script.schema.json) has the same, which a test holds it to.
#include "data/formats/json_object.h"

namespace ostium::script_keys {

inline const JsonObjectKeys root = {"script",
                                    {{"schema", true, "\"ostium-script/1\""},
                                     {"name", true, "the file's name without .json"},
                                     {"title", true, "what people call it, a text"},
                                     {"access", false, "where it comes in, as a case says it; if not said, anywhere"},
                                     {"tools", true, "what is used, the outermost first, a list of at least one"},
                                     {"landmarks", false, "points of one's own, a list"},
                                     {"steps", true, "what the operator does, in order, a list of at least one"}}};

inline const JsonObjectKeys tool = {
    "tool",
    {{"name", true, "what the script calls it: \"wire\""},
     {"instrument", true, "a name of `ostium instruments`, or a file"},
     {"sizes", false, "balloons or stents to choose from by the artery, or guides by the aorta, a list of such names"},
     {"of_reference", false,
      "their nominal diameter at most, over the healthy artery's beside the "
      "lesion, > 0 and at most 1.5; beside sizes"},
     {"of_aorta", false,
      "a guide's width at most, over the ascending aorta's diameter, > 0 and at most 3; beside sizes, instead of "
      "of_reference"},
     {"lesion", false,
      "which of the case's lesions, a whole number from 1 on; the first if it is not said; beside sizes and "
      "of_reference"}}};

inline const JsonObjectKeys landmark = {
    "landmark",
    {{"name", true, "what the script calls it"},
     {"at_mm", true, "a point of the patient frame in mm, three numbers: left, head, front"}}};

inline const JsonObjectKeys step = {
    "step",
    {{"do", true, "what is done"},
     {"script", false,
      "the name of a script without .json, as seen from this one's folder: its steps stand here, with this script's "
      "tools"},
     {"with", false, "beside script: what its tools are called here, an object of names"},
     {"lesion", false,
      "beside script: where its conditions are about a lesion and do not say which, a whole number from 1 on"},
     {"label", false,
      "a name of its own, for messages and for \"otherwise\"; beside script: what stands before the labels of its "
      "steps"},
     {"tool", false, "the name of a tool, or a list of those that are moved together"},
     {"speed_mm_s", false, "how fast, in mm/s, > 0 and at most 500"},
     {"turn_deg_s", false,
      "how fast it is turned, in degrees/s, not 0, at most 3600; clockwise from behind is positive"},
     {"until", false, "a list of conditions; the first that holds ends the step"},
     {"unless", false, "a list of conditions; if one of them holds first, the step has failed"},
     {"timeout_s", false, "after this many seconds the step has failed, > 0 and at most 3600"},
     {"otherwise", false,
      "what a failure leads to: \"fail\" (if it is not said), \"go on\" or the label of a step; beside script: the "
      "label that its steps lead to where the run would end"},
     {"tries", false,
      "how often \"otherwise\" leads to that step, a whole number, 1 to 100, 1 if it is not said; then it is a "
      "failure"},
     {"last_resort", false,
      "the label of a step, beside otherwise: when tries are used up it is gone to, once, and there are as many again"},
     {"detour", false,
      "true: only another step's \"otherwise\" or \"last_resort\" leads to it, or a detour before it; what goes on "
      "from elsewhere goes past it. Not the first step"},
     {"view", false, "a name of `ostium views`"},
     {"lao_deg", false, "the C-arm's angle in degrees, -120 to 120; negative: RAO"},
     {"cran_deg", false, "the C-arm's angle in degrees, -55 to 55; negative: caudal"},
     {"table_mm", false, "the isocentre in the patient in mm, three numbers: left, head, front"},
     {"field_mm", false, "side of the detector's field in mm: 200, 160 or 130"},
     {"on", false, "true or false"},
     {"rate_1_min", false, "beats a minute, 40 to 180"},
     {"text", false, "a text"},
     {"rate_mL_s", false, "how fast the thumb pushes, in mL/s, > 0 and at most 20"},
     {"volume_mL", false, "how much, in mL, > 0 and at most 60"},
     {"iodine_mg_mL", false, "of what is in the syringe, 0 (saline) to 400; 350 if it is not said"},
     {"gauge_atm", false, "pressure at the inflation device in atm, 0 to 30"},
     {"over_s", false, "in how many seconds that is reached, > 0 and at most 60"},
     {"heparin_U", false, "dose, > 0 and at most 20000"},
     {"nitrate_ug", false, "dose, into the coronary, > 0 and at most 1000"},
     {"adenosine_ug", false, "dose, into the coronary, > 0 and at most 1000"}}};

inline const JsonObjectKeys condition = {
    "condition",
    {{"tip_passes", false, "a landmark: the tip is there or beyond, as seen from the access"},
     {"tip_leaves", false, "a landmark: the tip is on the near side of it"},
     {"tip_in", false, "the name of a branch: the tip is in it, or in one that leaves it"},
     {"tip_on", false, "the name of a branch: the tip is in it, and in none that leaves it"},
     {"tip_astray", false, "the name of a branch: the tip is in one that leaves it, so far as by_mm says"},
     {"by_mm", false, "beside tip_astray: how far from the line of that branch, in mm, > 0"},
     {"tip_points", false, "where the tip points"},
     {"tip_faces", false, "the name of a branch: the tip points to the side of the vessel that the branch leaves from"},
     {"if_there", false, "true or false, beside tip_in, tip_leaves and tip_passes"},
     {"within_deg", false, "how exactly, in degrees, > 0 and at most 90; beside tip_points and tip_faces"},
     {"tip_drops_mm", false, "how far the tip jumps in 0.25 s beyond what the hand moved, in mm, > 0"},
     {"fed_mm", false, "length fed or drawn back since the step began, in mm, > 0"},
     {"inserted_mm", false, "length in the body, reached from either side, in mm, >= 0"},
     {"out", false, "true: the tool is out of the body"},
     {"turned_deg", false, "turn since the step began, either way, in degrees, > 0"},
     {"hub_within_deg", false,
      "the hand's turns, one way less the other, add up to no more degrees: the hub is as it was at first, > 0"},
     {"push_exceeds_N", false, "push or pull at the hand in N, > 0; forces are felt behind a low pass of 10 Hz"},
     {"torque_exceeds_mNm", false, "torque at the hand in mN m, > 0"},
     {"wall_force_exceeds_N", false, "sum of the walls' normal forces on the tool in N, > 0"},
     {"tip_force_exceeds_N", false, "that on its last 10 mm in N, > 0"},
     {"seconds", false, "since the step began, > 0"},
     {"beats", false, "of the heart since the step began, > 0"},
     {"balloon_at_mm", false,
      "the middle between the markers, from the middle of the lesion, along the artery, in mm, distal is "
      "positive: reached from either side, judged while the heart rests"},
     {"balloon_within_mm", false,
      "that middle is no farther from the lesion's, either way, in mm, > 0; judged while the heart rests"},
     {"balloon_clear_of_guide_mm", false,
      "its proximal marker is so far out of the guide, or the guide is out of the body, in mm, > 0"},
     {"balloon_open", false, "true: its waist is gone"},
     {"balloon_empty", false, "true: nothing is seen in the balloon"},
     {"engaged", false, "an artery that leaves the aorta: the guide's tip is in its ostium"},
     {"trace", false, "what the guide's pressure looked like in the last beat"},
     {"contrast_in", false, "a landmark in a coronary artery: contrast is seen there while the beam is on"},
     {"flow_below_percent", false, "of what the muscle behind the lesion needs, > 0"},
     {"ST_exceeds_mV", false, "largest shift in the leads, > 0"},
     {"act_exceeds_s", false, "activated clotting time, > 0"},
     {"stenosis_below_percent", false, "of the lesion's diameter, as measured on a film, > 0 and at most 100"},
     {"unharmed", false, "true: no artery is perforated, no dissection of type C to F lies outside a stent"},
     {"stent_beyond_mm", false,
      "stents cover the lesion without a gap and reach so far beyond it at both ends, in mm, > 0; no farther than the "
      "artery goes"},
     {"lesion", false,
      "which of the case's lesions, a whole number from 1 on; the first if it is not said; beside what is about one"},
     {"of", false, "which tool is meant; else the step's first"}}};

inline const std::vector<const JsonObjectKeys*> all = {&root, &tool, &landmark, &step, &condition};

}  // namespace ostium::script_keys
