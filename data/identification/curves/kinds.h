#pragma once
/// The kinds of curves.
#include "data/identification/curves/set/set_reader.h"

namespace ostium::data::curves {

/// In the order in which they are listed to users.
const std::vector<Kind>& kinds();

/// The kind that the file names, or null: then it is a set of shapes. Throws LoadError for a kind that is unknown.
const Kind* kind_of(const JsonValue& root);

std::unique_ptr<Set> read_set(const JsonValue& root);

}  // namespace ostium::data::curves
