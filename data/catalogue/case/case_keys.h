#pragma once
/// The keys of a case file, object by object: what the reader accepts, and how each is described. The schema
/// (data/schemas/case.schema.json) is generated from them.
#include "data/catalogue/case/case.h"
#include "data/formats/json/json_object.h"

namespace ostium::data::case_keys {

inline const JsonObjectKeys root = {
    "case",
    {{"schema", true, "\"ostium-case/1\"", json_type::constant("ostium-case/1")},
     {"name", true, "the file's name without .json", json_type::text()},
     {"title", true, "what people call it, a text", json_type::text()},
     {"card", true, "what the operator is told, an object", json_type::object("card")},
     {"anatomy", false, "whose vessels, an object; or imported", json_type::object("anatomy")},
     {"imported", false, "someone's own vessels, an object; or anatomy", json_type::object("imported")},
     {"heart_rate_1_min", true, "beats a minute, 40 to 180", json_type::number(from_to(40, 180))},
     {"lesions", true, "narrowings, a list", json_type::list_of(json_type::object("lesion"))},
     {"views", false, "of its lesions, beside the standard ones, a list",
      json_type::list_of(json_type::object("view"))}},
    {one_of_required({{"anatomy"}, {"imported"}})}};

inline const JsonObjectKeys card = {"card",
                                    {{"history", true, "a text", json_type::text()},
                                     {"ecg", true, "a text", json_type::text()},
                                     {"planned_access", true, "a text", json_type::text()}}};

inline const JsonObjectKeys anatomy = {
    "anatomy",
    {{"dominance", true, "which artery reaches the back of the heart",
      json_type::choice({"right", "left", "balanced"})},
     {"access", true, "where the sheath is", json_type::choice(access_names())},
     {"seed", true, "a whole number, >= 0: which person; 0 is the mean of the literature",
      json_type::whole(from_zero)}}};

inline const JsonObjectKeys imported = {
    "imported",
    {{"anatomy", true, "tubes and landmarks, a file's name beside this one", json_type::text()},
     {"lumen", true, "the closed surface, patient frame, mm: a file's name beside this one (PLY, OBJ, STL)",
      json_type::text()},
     {"frames", false,
      "the same surface later in the beat, evenly spaced, the R wave's being lumen: a list of at least three files' "
      "names beside this one",
      json_type::list_of(json_type::text(), 3)}}};

inline const JsonObjectKeys lesion = {
    "lesion",
    {{"branch", true, "the name of a coronary artery", json_type::text()},
     {"from_mm", true,
      "the proximal end in mm from the branch's origin, >= 0; with at_branch from there, or before it, < 0",
      json_type::number({})},
     {"at_branch", false, "a branch of that branch: from_mm is from where it leaves, in every person",
      json_type::text()},
     {"length_mm", true, "the length in mm, at least 3, within the branch", json_type::number({.least = 3})},
     {"stenosis_percent", true, "what is missing of the diameter where it is narrowest, in %, 1 to 95: 70, not 0.7",
      json_type::number(from_to(1, 95))},
     {"shape", true, "on all sides or on one", json_type::choice({"concentric", "eccentric"})},
     {"side_deg", false,
      "an eccentric plaque's side in degrees, -360 to 360, 0 towards the heart; for eccentric ones only",
      json_type::number(from_to(-360, 360))},
     {"calcified", true, "true or false", json_type::boolean()},
     {"calcium_arc_deg", false,
      "the calcium's arc seen along the artery, in degrees, 0 to 360: 120 or more if calcified, less if not; otherwise "
      "225, or 0",
      json_type::number(from_to(0, 360))},
     {"calcium_thickness_mm", false, "its thickness in mm, > 0 and at most 2; otherwise 0.7",
      json_type::number(above_zero_to(2))},
     {"calcium_length_mm", false, "its length about the lesion's middle, in mm; otherwise 0.7 of the lesion's",
      json_type::number(above_zero)},
     {"hardness", false, "of the plaque's soft part, as a multiple of a typical plaque's, 0.2 to 5; otherwise 1",
      json_type::number(from_to(0.2, 5))}}};

inline const JsonObjectKeys view = {
    "view",
    {{"name", true, "how `--view` calls it, a text", json_type::text()},
     {"lao_deg", true, "LAO in degrees, -120 to 120; negative: RAO", json_type::number(from_to(-120, 120))},
     {"cran_deg", true, "cranial in degrees, -55 to 55; negative: caudal", json_type::number(from_to(-55, 55))}}};

inline const std::vector<const JsonObjectKeys*> all = {&root, &card, &anatomy, &imported, &lesion, &view};

}  // namespace ostium::data::case_keys
