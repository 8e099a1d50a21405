#pragma once
/// The keys of an anatomy file; data/schemas/anatomy.schema.json has the same.
#include "data/formats/json_object.h"

namespace ostium::anatomy_keys {

inline const JsonObjectKeys root = {"anatomy",
                                    {{"schema", true, "\"ostium-anatomy/1\""},
                                     {"aorta", true, "whether the first tube is the aorta, true or false"},
                                     {"ascending_mm", true, "length of it that moves with the heart, in mm, > 20"},
                                     {"tubes", true, "vessels, parents first, a list that is not empty"},
                                     {"branches", true, "names of stretches of tubes, a list"},
                                     {"landmarks", true, "of heart and access, an object"}}};

inline const JsonObjectKeys tube = {
    "tube",
    {{"name", true, "a text"},
     {"parent", true, "the index of an earlier tube, or -1"},
     {"blend", true, "width of the rounding where it joins, in its own radii, > 0"},
     {"nodes", true, "[x, y, z, radius] in mm each, two at least, no two neighbours equal"}}};

inline const JsonObjectKeys branch = {
    "branch",
    {{"name", true, "a text"},
     {"tube", true, "the index of a tube"},
     {"from_mm", true, "where it begins along the tube, in mm, >= 0"},
     {"to_mm", true, "where it ends along the tube, in mm, not before its beginning"}}};

inline const JsonObjectKeys landmarks = {
    "landmarks",
    {{"access_mm", true, "three numbers, mm: where instruments enter, in the lumen"},
     {"access_direction", true, "three numbers: the way they go in"},
     {"left_ostium_mm", true, "three numbers, mm"},
     {"right_ostium_mm", true, "three numbers, mm"},
     {"annulus_mm", true, "three numbers, mm: its middle"},
     {"root_axis", true, "three numbers: from the annulus to the ascending aorta"},
     {"lv_base_mm", true, "three numbers, mm: the left ventricle's axis in the plane of the AV groove"},
     {"lv_apex_mm", true, "three numbers, mm"},
     {"right_groove", true, "three numbers: across that axis, to the middle of the right groove"}}};

inline const std::vector<const JsonObjectKeys*> all = {&root, &tube, &branch, &landmarks};

}  // namespace ostium::anatomy_keys
