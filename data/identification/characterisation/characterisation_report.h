#pragma once
/// Writes what several sets say of an instrument: the instrument's file, characterisation.json (schema
/// ostium-characterisation/1), and a page.
#include "data/catalogue/instrument/instrument.h"
#include "data/identification/characterisation/characterise.h"

namespace ostium::data {

/// The instrument (schema ostium-instrument/1), named as its file must be: `like` with each stretch's stiffness, its
/// standard error, and which sets it is from.
std::string instrument_json(const Characterisation& c, const std::string& name);

/// An instrument of the catalogue, with the errors and the friction that its file has: what `check` takes.
CharacterisedWire wire_in(const Instrument& instrument);

std::string to_json(const Characterisation& c);

/// A self-contained page: plots inline, no scripts.
std::string to_html(const Characterisation& c);

/// What `check` found, in words for a person, and as an object for prediction.json.
std::string words_of(const WireCheck& check);
std::string to_json(const WireCheck& check);

}  // namespace ostium::data
