#pragma once
/// The list of all effects, and which of them a set declares or can show.
#include "data/identification/effects/effect.h"

namespace ostium::data {

/// In the order in which they are listed to users.
const std::vector<Effect>& effects();

/// Throws LoadError listing the effects if `id` is unknown.
const Effect& find_effect(const std::string& id);

/// Whether some data cannot distinguish the two effects.
bool often_confused(const std::string& a, const std::string& b);

/// All candidates for this set but laws: every effect that can show, on every instrument, in every form.
std::vector<ActiveEffect> everything_to_try(const MeasurementSet& set);

/// The laws that can be learned from this set.
std::vector<ActiveEffect> laws_to_try(const MeasurementSet& set);

/// The effects that the set's file declares. Throws LoadError for an effect that is unknown, out of range or cannot act
/// there.
std::vector<ActiveEffect> declared_effects(const MeasurementSet& set);

}  // namespace ostium::data
