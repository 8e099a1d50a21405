#pragma once
/// All effects that there are, and which of them a set declares or can show.
#include "data/identification/effects/effect.h"

namespace ostium::data {

/// In the order in which people see them listed.
const std::vector<Effect>& effects();

/// Throws LoadError naming the effects that there are.
const Effect& find_effect(const std::string& id);

/// Whether there are data that cannot tell one effect from the other.
bool often_confused(const std::string& a, const std::string& b);

/// What could be switched on in this set: every effect that can show, on every instrument, in every form.
std::vector<ActiveEffect> everything_to_try(const MeasurementSet& set);

/// The effects that the set's file declares. Throws LoadError for what is unknown, out of range or cannot act there.
std::vector<ActiveEffect> declared_effects(const MeasurementSet& set);

}  // namespace ostium::data
