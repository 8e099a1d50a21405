#pragma once
/// Effects: what a measured set may show and its declaration leaves out. Each is a separate switch, off by default, in
/// a header and source of its own, and changes what the forward model is made of, not the model's equations.
///
/// Adding one: its header and source here, its line in the list in effect.cpp, its parameters in
/// data/schemas/effects.schema.json, its test in tests/data.
#include "data/forward/setup.h"

namespace ostium {

struct EffectParameter {
  std::string name;   ///< with its unit, as in files: "time_1_s"
  std::string unit;   ///< "1" if there is none
  std::string what;   ///< in words
  double prior = 0;   ///< what is expected before looking; in files that leave it out, the value
  double spread = 0;  ///< of the prior: standard deviation, of its logarithm if `logarithmic`
  double least = 0, most = 0;
  bool logarithmic = false;
};

struct Effect {
  std::string id;
  std::string what;  ///< in words, after "with": "twist of the shafts behind the base"
  std::vector<EffectParameter> parameters;
  /// Empty if the effect can show in this set on this instrument (none: on all it can act on), or why not.
  std::string (*why_not)(const MeasurementSet&, std::optional<int> instrument);
  void (*apply)(const ActiveEffect&, const MeasurementSet&, const Experiment&, Setup&);
};

/// All effects that there are, in the order in which they are listed to people.
const std::vector<Effect>& effects();

/// Throws LoadError naming the effects that there are.
const Effect& find_effect(const std::string& id);

/// The effects that the set's file declares. Throws LoadError for what is unknown, out of range or cannot act there.
std::vector<ActiveEffect> declared_effects(const MeasurementSet& set);

}  // namespace ostium
