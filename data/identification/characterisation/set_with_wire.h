#pragma once
/// A measured set with its instrument's stiffness, and the friction of its rig, from elsewhere.
#include "data/formats/json/json_value.h"
#include "data/identification/characterisation/characterised_wire.h"

namespace ostium::data {

/// What takes the place of what the set declares.
struct WireInSet {
  std::vector<DeclaredStretch> stretches;  ///< from the tip, without gaps; what lies beyond them stays as declared
  std::optional<double> friction;          ///< none: as declared
};

/// `root`, the file of a set of any kind that has sections, with these. Sections are cut where the stretches end.
/// Throws LoadError if it has no sections, or several instruments.
JsonValue set_with(const JsonValue& root, const WireInSet& wire);

}  // namespace ostium::data
