#pragma once
/// The keys of an anatomy file; data/schemas/anatomy.schema.json is made of them.
#include "data/formats/json/json_object.h"

namespace ostium::data::anatomy_keys {

inline const JsonObjectKeys root = {
    "anatomy",
    {{"schema", true, "\"ostium-anatomy/1\"", json_type::constant("ostium-anatomy/1")},
     {"aorta", true, "whether the first tube is the aorta, true or false", json_type::boolean()},
     {"ascending_mm", true, "length of it that moves with the heart, in mm, > 20",
      json_type::number(JsonRange{.above = 20})},
     {"tubes", true, "vessels, parents first, a list that is not empty",
      json_type::list_of(json_type::object("tube"), 1)},
     {"branches", true, "names of stretches of tubes, a list", json_type::list_of(json_type::object("branch"))},
     {"landmarks", true, "of heart and access, an object", json_type::object("landmarks")}}};

inline const JsonObjectKeys tube = {
    "tube",
    {{"name", true, "a text", json_type::text()},
     {"parent", true, "the index of an earlier tube, or -1", json_type::whole(JsonRange{.least = -1})},
     {"blend", true, "width of the rounding where it joins, in its own radii, > 0", json_type::number(above_zero)},
     {"nodes", true, "[x, y, z, radius] in mm each, two at least, no two neighbours equal",
      json_type::list_of(json_type::numbers(4), 2)}}};

inline const JsonObjectKeys branch = {
    "branch",
    {{"name", true, "a text", json_type::text()},
     {"tube", true, "the index of a tube", json_type::whole(from_zero)},
     {"from_mm", true, "where it begins along the tube, in mm, >= 0", json_type::number(from_zero)},
     {"to_mm", true, "where it ends along the tube, in mm, not before its beginning", json_type::number(from_zero)}}};

inline const JsonObjectKeys landmarks = {
    "landmarks",
    {{"access_mm", true, "three numbers, mm: where instruments enter, in the lumen", json_type::numbers(3)},
     {"access_direction", true, "three numbers: the way they go in", json_type::numbers(3)},
     {"left_ostium_mm", true, "three numbers, mm", json_type::numbers(3)},
     {"right_ostium_mm", true, "three numbers, mm", json_type::numbers(3)},
     {"annulus_mm", true, "three numbers, mm: its middle", json_type::numbers(3)},
     {"root_axis", true, "three numbers: from the annulus to the ascending aorta", json_type::numbers(3)},
     {"lv_base_mm", true, "three numbers, mm: the left ventricle's axis in the plane of the AV groove",
      json_type::numbers(3)},
     {"lv_apex_mm", true, "three numbers, mm", json_type::numbers(3)},
     {"right_groove", true, "three numbers: across that axis, to the middle of the right groove",
      json_type::numbers(3)}}};

inline const std::vector<const JsonObjectKeys*> all = {&root, &tube, &branch, &landmarks};

}  // namespace ostium::data::anatomy_keys
