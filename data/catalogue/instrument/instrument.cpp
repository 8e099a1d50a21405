#include "data/catalogue/instrument/instrument.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace ostium::data {

namespace {

constexpr double rounding_m = 1e-9;  ///< of lengths given in mm

}  // namespace

const std::vector<std::string>& instrument_kinds() {
  static const std::vector<std::string> names = {"wire",   "guide_catheter", "diagnostic_catheter",
                                                 "sheath", "balloon_shaft",  "stent_shaft"};
  return names;
}

std::string words_for(InstrumentKind kind) {
  std::string words = instrument_kinds().at(static_cast<std::size_t>(kind));
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

const std::vector<std::string>& opaque_materials() {
  static const std::vector<std::string> names = {"polymer",  "steel",    "nitinol", "cobalt_chromium",
                                                 "platinum", "tungsten", "gold",    "barium_sulphate"};
  return names;
}

std::string source_mark(const Instrument& instrument) {
  const auto estimates = std::count_if(instrument.sources.begin(), instrument.sources.end(),
                                       [](const Source& source) { return source.estimate(); });
  if (estimates == 0) return "published";
  return static_cast<std::size_t>(estimates) == instrument.sources.size() ? "estimate" : "mixed";
}

core::RodDescription rod_description(const Instrument& instrument, std::vector<double> element_lengths_m) {
  core::RodDescription description;
  description.name = instrument.name;
  description.sections = instrument.sections;
  description.relaxation = instrument.relaxation;
  description.element_lengths_m = std::move(element_lengths_m);
  check(description);
  return description;
}

Instrument with_tip_shape(const Instrument& wire, const std::vector<ShapePiece>& pieces) {
  if (!wire.shapeable_tip) throw std::invalid_argument(wire.name + ": this tip cannot be shaped");
  const double stretch = wire.shapeable_tip->length_m, length = length_of(pieces);
  for (const ShapePiece& piece : pieces)
    if (!(piece.length_m > 0 && piece.radius_m >= 0))
      throw std::invalid_argument(wire.name +
                                  ": a piece of the tip's shape must have a positive length and no negative radius");
  if (!(length <= stretch + rounding_m))
    throw std::invalid_argument(fmt::format("{}: the tip's shape is {:g} mm long; only {:g} mm can be shaped",
                                            wire.name, length * 1e3, stretch * 1e3));
  std::vector<ShapePiece> whole = pieces;  // straight proximal to the new shape, whatever was there before
  if (stretch - length > rounding_m) whole.push_back({.length_m = stretch - length});
  Instrument shaped = wire;
  shaped.sections = bent(wire.sections, whole);
  return shaped;
}

bool fits_inside(const Instrument& inner, const Instrument& outer) {
  return inner.needs_m <= outer.passes_m + rounding_m;
}

void require_fit(const Instrument& inner, const Instrument& outer) {
  if (fits_inside(inner, outer)) return;
  if (outer.passes_m == 0)
    throw std::invalid_argument(fmt::format("{} does not go into {}, which is a {} without a lumen", inner.name,
                                            outer.name, words_for(outer.kind)));
  throw std::invalid_argument(fmt::format(
      "{} does not go through {}: it is {:.3f} mm ({:.4f} in) thick and needs a lumen of {:.3f} mm, but this one is "
      "{:.3f} mm ({:.4f} in) wide and lets {:.3f} mm through",
      inner.name, outer.name, inner.outer_diameter_m * 1e3, inner.outer_diameter_m / 0.0254, inner.needs_m * 1e3,
      outer.inner_diameter_m * 1e3, outer.inner_diameter_m / 0.0254, outer.passes_m * 1e3));
}

}  // namespace ostium::data
