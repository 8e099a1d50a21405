#pragma once
/// Instruments at rest, as a cardiologist knows them from a catalogue page.
#include "data/catalogue/instrument/instrument.h"

namespace ostium::data {

/// Draws the distal ends side by side, unloaded, the shaft coming from above and plane 0 to the right, as an SVG file:
/// colour by bending stiffness, radiopaque stretches and markers, a scale bar for each, and the stiffness of the distal
/// 40 cm below it. Shapes are those that core gives a rod at rest. Throws std::runtime_error if the file cannot be
/// written.
void draw_instruments(const std::vector<Instrument>& instruments, const std::string& file);

}  // namespace ostium::data
