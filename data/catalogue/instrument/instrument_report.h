#pragma once
/// Instruments as text: a table, the details of one, and JSON.
#include "data/catalogue/instrument/instrument.h"

namespace ostium::data {

/// Heading and one line per instrument, without line end: name, kind, size, length, bending stiffness of tip and shaft,
/// source.
std::string instrument_heading();
std::string instrument_line(const Instrument& instrument);

/// Mean bending stiffness of a section's two axes, N mm2.
double EI_Nmm2(const core::Section& section);

/// "5.0F" for catheters and sheaths, "0.014 in" for wires, "0.99 mm" for balloon and stent shafts.
std::string nominal_size(const Instrument& instrument);

/// All details, as lines: sections, shape, X-ray, clearance, and the source of every number.
std::string instrument_details(const Instrument& instrument);

/// Array of objects, data/schemas/instruments.schema.json.
std::string to_json(const std::vector<Instrument>& instruments);

}  // namespace ostium::data
