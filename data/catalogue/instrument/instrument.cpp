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
  const auto all = [&](auto is) { return std::all_of(instrument.sources.begin(), instrument.sources.end(), is); };
  if (all([](const Source& s) { return s.estimate(); })) return "estimate";
  if (all([](const Source& s) { return s.measured(); })) return "measured";
  return all([](const Source& s) { return !s.estimate() && !s.measured(); }) ? "published" : "mixed";
}

std::vector<double> element_lengths(const Instrument& instrument) {
  constexpr double tip_m = 0.04, fine_m = 0.15, growth = 1.02, most_bent_rad = 0.2, least_m = 0.5e-3;
  const bool wide = instrument.kind == InstrumentKind::guide_catheter ||
                    instrument.kind == InstrumentKind::diagnostic_catheter || instrument.kind == InstrumentKind::sheath;
  const double body_m = wide ? 2e-3 : 1e-3, coarse_m = 4 * body_m;
  const auto bent_by_m = [&](double from_m, double to_m) {  // the longest allowed by the rest shape there
    double longest = coarse_m;
    for (const core::Section& s : instrument.sections)
      if (s.from_tip_m < to_m && s.to_tip_m > from_m && !s.rest_curvature_per_m.isZero())
        longest = std::min(longest, most_bent_rad / s.rest_curvature_per_m.norm());
    return std::max(least_m, longest);
  };
  std::vector<double> from_tip;
  double at_m = 0, length_m = 1e-3;
  while (at_m < instrument.length_m - rounding_m) {
    if (at_m > fine_m)
      length_m = std::min(coarse_m, growth * length_m);
    else if (at_m > tip_m)
      length_m = body_m;
    const double here_m = std::min(length_m, bent_by_m(at_m, at_m + length_m));
    from_tip.push_back(std::min(here_m, instrument.length_m - at_m));
    at_m += from_tip.back();
  }
  if (from_tip.size() > 1 && from_tip.back() < least_m)
    from_tip[from_tip.size() - 2] += from_tip.back(), from_tip.pop_back();
  return {from_tip.rbegin(), from_tip.rend()};
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
