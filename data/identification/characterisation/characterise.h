#pragma once
/// An instrument from several measured sets of it: each is explained by itself, and what they say of stiffness and
/// friction is combined. Then each is predicted by what the others say.
#include <functional>
#include <variant>

#include "data/identification/characterisation/wire_check.h"
#include "data/identification/selection/explain.h"

namespace ostium::data {

struct CharacteriseOptions {
  int threads = 0;  ///< 0: one for each core
  std::function<void(const std::string&)> progress;
  std::function<bool()> stop = {};  ///< true: end early, with the sets that are done
};

/// One set, and what it says by itself.
struct CharacterisedSet {
  std::string name;  ///< its folder's
  JsonValue root;
  MeasurementSet shapes;  ///< of a set of shapes
  std::variant<Explanation, curves::CurveExplanation> found;
  std::vector<StiffnessEstimate> stiffness;
  std::optional<FrictionEstimate> friction;
  std::string why_unused;          ///< empty: it counts
  std::optional<WireCheck> check;  ///< against what the other sets say; none: they say nothing of what it shows

  Verdict verdict() const;
  std::vector<std::string> effects() const;
  bool used() const { return why_unused.empty(); }
};

struct Characterisation {
  std::vector<CharacterisedSet> sets;
  std::vector<DeclaredStretch> declared;
  CharacterisedWire wire;
  std::vector<std::string> text;  ///< the findings, in words
  std::string like;               ///< the instrument's file that all else is taken from (schema ostium-instrument/1)
};

/// `files`: each a set's folder or its measurement.json, all of one instrument. `like`: text of an instrument's file
/// that gives what was not measured, weight and sizes say; empty: that of the first set of shapes. Throws LoadError for
/// a set that cannot be read, that is of several instruments, or of no instrument with sections; and if nothing gives
/// what was not measured. Throws std::runtime_error if it was ended before any set did.
Characterisation characterise(const std::vector<std::string>& files, const std::string& like,
                              const CharacteriseOptions& options);

}  // namespace ostium::data
