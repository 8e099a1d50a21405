#pragma once
/// An effect is something that a measured set may show and its declaration leaves out. Each is a separate switch, off
/// by default, and changes the forward model's inputs, never its equations.
#include <functional>

#include "data/identification/effects/experiment_setup.h"
#include "data/identification/effects/law_curve.h"
#include "data/identification/effects/measured_view.h"
#include "data/identification/measurement/measurement_set.h"

namespace ostium::data {

struct EffectParameter {
  std::string name;   ///< with its unit, as in files: "time_1_s"
  std::string unit;   ///< "1" if there is none
  std::string what;   ///< in words
  double prior = 0;   ///< expected before any data; used where a file gives no value
  double spread = 0;  ///< standard deviation of the prior; of the logarithm if `logarithmic`
  double least = 0, most = 0;
  bool logarithmic = false;
};

/// A variant of an effect: which of its parameters are held fixed, and at what. The others are fitted.
struct EffectForm {
  std::string name;  ///< "" if there is only one form
  std::vector<std::pair<std::string, double>> held;
};

/// The name of a form that is the same as the one before and makes sense beside that alone.
inline constexpr const char* another_form = "another";

struct ActiveEffect;
struct Changes;

struct Effect {
  std::string id;
  std::string what;  ///< phrase that follows "with": "twist of the shafts behind the base"
  std::vector<EffectParameter> parameters;
  /// Empty if the effect can show in this set on this instrument (none: on all it can act on), else the reason why not.
  std::string (*why_not)(const MeasurementSet&, std::optional<int> instrument) = nullptr;
  /// Changes the instruments, loads or base; null if it changes none.
  void (*apply)(const ActiveEffect&, const MeasurementSet&, const Experiment&, ExperimentSetup&) = nullptr;
  /// Changes how a shape appears in the measurement; null if it does not.
  void (*see)(const ActiveEffect&, const MeasurementSet&, const Experiment&, MeasuredView&) = nullptr;
  /// Adapts priors and ranges to the size of this set; null: they are as listed.
  void (*adapt)(const MeasurementSet&, std::optional<int> instrument, std::vector<EffectParameter>&) = nullptr;
  /// The forms to try in this set; null: one, with nothing held fixed.
  std::vector<EffectForm> (*forms)(const MeasurementSet&, std::optional<int> instrument) = nullptr;
  /// A law that is learned: its curve. Such effects are tried where the others leave something. Null: it is none.
  LawCurve (*law)(const ActiveEffect&, const MeasurementSet&, const Changes&) = nullptr;
  bool of_one_instrument = false;     ///< each nested instrument can have its own
  bool of_several_stretches = false;  ///< may be switched on several times, in different forms
  bool in_instrument = false;         ///< a property of the instrument, not of the rig, the room or the imaging
  bool parts_views = false;           ///< the later views of a set see another shape than the first
  std::string confused_with;          ///< id of an effect that some data cannot distinguish from this one; "" if none
};

/// An effect that is switched on.
struct ActiveEffect {
  const Effect* effect = nullptr;
  std::optional<int> instrument;  ///< none: all that it can act on
  std::vector<double> values;     ///< in the order of effect->parameters
  std::vector<bool> held;         ///< which of effect->parameters are not fitted; empty: all are fitted
  std::string form;               ///< "" if there is only one form

  std::string name() const;  ///< "rest_curvature[1] (section 2)"
};

/// How the model differs from the declaration.
struct Changes {
  std::vector<std::vector<double>> stiffness_scale;  ///< per instrument and section; empty: 1 everywhere
  std::vector<ActiveEffect> effects;
};

/// The effect's parameters with priors and ranges adapted to this set.
std::vector<EffectParameter> parameters_of(const Effect& effect, const MeasurementSet& set,
                                           std::optional<int> instrument);

/// The effect in one of its forms, with parameters at their priors.
ActiveEffect active(const Effect& effect, const MeasurementSet& set, std::optional<int> instrument,
                    const EffectForm& form);

}  // namespace ostium::data
