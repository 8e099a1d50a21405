#pragma once
/// Instruments in words: a table, the details of one, and JSON.
#include "data/catalogue/instrument/instrument.h"

namespace ostium::data {

/// One line each, without line end: name, kind, size, length, bending stiffness of tip and shaft, where from.
std::string instrument_heading();
std::string instrument_line(const Instrument& instrument);

/// "5.0F" of catheters and sheaths, "0.014 in" of wires, "0.99 mm" of balloon and stent shafts.
std::string nominal_size(const Instrument& instrument);

/// Everything, in lines: sections, shape, X-ray, clearance, and the source of every number.
std::string instrument_details(const Instrument& instrument);

/// Array of objects, data/schemas/instruments.schema.json.
std::string to_json(const std::vector<Instrument>& instruments);

}  // namespace ostium::data
