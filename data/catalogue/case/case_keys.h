#pragma once
/// The keys of a case file, object by object: what the reader accepts, and what it says of each. The schema
/// (data/schemas/case.schema.json) has the same, which a test holds it to.
#include "data/formats/json_object.h"

namespace ostium::case_keys {

inline const JsonObjectKeys root = {"case",
                                    {{"schema", true, "\"ostium-case/1\""},
                                     {"name", true, "the file's name without .json"},
                                     {"title", true, "what people call it, a text"},
                                     {"card", true, "what the operator is told, an object"},
                                     {"anatomy", false, "whose vessels, an object; or imported"},
                                     {"imported", false, "someone's own vessels, an object; or anatomy"},
                                     {"heart_rate_1_min", true, "beats a minute, 40 to 180"},
                                     {"lesions", true, "narrowings, a list"}}};

inline const JsonObjectKeys card = {
    "card", {{"history", true, "a text"}, {"ecg", true, "a text"}, {"planned_access", true, "a text"}}};

inline const JsonObjectKeys anatomy = {
    "anatomy",
    {{"dominance", true, "which artery reaches the back of the heart"},
     {"access", true, "where the sheath is"},
     {"seed", true, "a whole number, >= 0: which person; 0 is the mean of the literature"}}};

inline const JsonObjectKeys imported = {
    "imported",
    {{"anatomy", true, "tubes and landmarks, a file's name beside this one"},
     {"lumen", true, "the closed surface, patient frame, mm: a file's name beside this one (PLY, OBJ, STL)"},
     {"frames", false,
      "the same surface later in the beat, evenly spaced, the R wave's being lumen: a list of at least three files' "
      "names beside this one"}}};

inline const JsonObjectKeys lesion = {
    "lesion",
    {{"branch", true, "the name of a coronary artery"},
     {"from_mm", true, "the proximal end in mm from the branch's origin, >= 0"},
     {"length_mm", true, "the length in mm, > 0, within the branch"},
     {"stenosis_percent", true, "what is missing of the diameter where it is narrowest, in %, > 0 and at most 95"},
     {"shape", true, "on all sides or on one"},
     {"side_deg", false, "an eccentric plaque's side in degrees, 0 towards the heart; for eccentric ones only"},
     {"calcified", true, "true or false"}}};

inline const std::vector<const JsonObjectKeys*> all = {&root, &card, &anatomy, &imported, &lesion};

}  // namespace ostium::case_keys
