#pragma once
/// The keys of a tree file; data/schemas/tree.schema.json is made of them.
#include "data/formats/json/json_object.h"

namespace ostium::data::tree_keys {

inline const JsonObjectKeys tree = {
    "tree",
    {{"schema", true, "\"ostium-tree/1\"", json_type::constant("ostium-tree/1")},
     {"branches", true, "branches, parents first, a list", json_type::list_of(json_type::object("branch"))}}};

inline const JsonObjectKeys branch = {
    "branch",
    {{"name", true, "a text", json_type::text()},
     {"parent", true, "the index of an earlier branch, or -1", json_type::whole(JsonRange{.least = -1})},
     {"parent_sphere", true, "the index of a sphere of the parent, or -1 without a parent",
      json_type::whole(JsonRange{.least = -1})},
     {"spheres", true, "[x, y, z, radius] in mm each, one at least", json_type::list_of(json_type::numbers(4), 1)}}};

inline const std::vector<const JsonObjectKeys*> all = {&tree, &branch};

}  // namespace ostium::data::tree_keys
