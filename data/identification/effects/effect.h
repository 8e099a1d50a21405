#pragma once
/// Effects: what a measured set may show and its declaration leaves out. Each is a separate switch, off by default, in
/// a header and source of its own, and changes what the forward model is made of, not the model's equations.
///
/// Adding one: its header and source here, its line in the list in effect.cpp, its parameters in
/// data/schemas/effects.schema.json, its test in tests/data.
#include "data/identification/forward/setup.h"

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

/// A shape that an effect can take: which of its parameters are held, and at what. The others are fitted.
struct EffectForm {
  std::string name;  ///< "" if there is one only
  std::vector<std::pair<std::string, double>> held;
};

struct MeasuredView;

struct Effect {
  std::string id;
  std::string what;  ///< in words, after "with": "twist of the shafts behind the base"
  std::vector<EffectParameter> parameters;
  /// Empty if the effect can show in this set on this instrument (none: on all it can act on), or why not.
  std::string (*why_not)(const MeasurementSet&, std::optional<int> instrument) = nullptr;
  /// Changes the instruments, loads or base; null: none of them.
  void (*apply)(const ActiveEffect&, const MeasurementSet&, const Experiment&, Setup&) = nullptr;
  /// Changes how a shape appears in the measurement; null: nothing.
  void (*see)(const ActiveEffect&, const MeasurementSet&, const Experiment&, MeasuredView&) = nullptr;
  /// Brings priors and ranges to the size of this set; null: they are as listed.
  void (*adapt)(const MeasurementSet&, std::optional<int> instrument, std::vector<EffectParameter>&) = nullptr;
  /// The forms to try in this set; null: one, with nothing held.
  std::vector<EffectForm> (*forms)(const MeasurementSet&, std::optional<int> instrument) = nullptr;
  bool of_one_instrument = false;  ///< nested instruments may have it one by one
};

/// The effect's parameters with priors and ranges that fit this set.
std::vector<EffectParameter> parameters_of(const Effect& effect, const MeasurementSet& set,
                                           std::optional<int> instrument);

/// The effect in one of its forms, at its priors.
ActiveEffect active(const Effect& effect, const MeasurementSet& set, std::optional<int> instrument,
                    const EffectForm& form);

/// What could be switched on in this set: every effect that can show, on every instrument, in every form.
std::vector<ActiveEffect> everything_to_try(const MeasurementSet& set);

/// All effects that there are, in the order in which they are listed to people.
const std::vector<Effect>& effects();

/// Throws LoadError naming the effects that there are.
const Effect& find_effect(const std::string& id);

/// The effects that the set's file declares. Throws LoadError for what is unknown, out of range or cannot act there.
std::vector<ActiveEffect> declared_effects(const MeasurementSet& set);

}  // namespace ostium
