#pragma once
/// The keys of a tree file; data/schemas/tree.schema.json has the same.
#include "data/formats/json_object.h"

namespace ostium::tree_keys {

inline const JsonObjectKeys tree = {
    "tree", {{"schema", true, "\"ostium-tree/1\""}, {"branches", true, "branches, parents first, a list"}}};

inline const JsonObjectKeys branch = {
    "branch",
    {{"name", true, "a text"},
     {"parent", true, "the index of an earlier branch, or -1"},
     {"parent_sphere", true, "the index of a sphere of the parent, or -1 without a parent"},
     {"spheres", true, "[x, y, z, radius] in mm each, one at least"}}};

inline const std::vector<const JsonObjectKeys*> all = {&tree, &branch};

}  // namespace ostium::tree_keys
