#pragma once
/// Drawings of instruments at rest, like a manufacturer's catalogue page.
#include "data/catalogue/instrument/instrument.h"

namespace ostium::data {

/// Draws the distal ends side by side, unloaded, as an SVG file; the shaft comes from above and plane 0 is to the
/// right. Colour shows bending stiffness; also drawn are radiopaque stretches, markers, a scale bar each, and below it
/// the stiffness of the distal 40 cm. Shapes are computed by core from rods at rest. Throws std::runtime_error if the
/// file cannot be written.
void draw_instruments(const std::vector<Instrument>& instruments, const std::string& file);

}  // namespace ostium::data
