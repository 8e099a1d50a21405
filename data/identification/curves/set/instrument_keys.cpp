#include "data/identification/curves/set/instrument_keys.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/units.h"

namespace ostium::data::curves {

namespace {

using units::mm, units::Nmm2;

constexpr double touching_mm = 1e-6;                 // sections that are so close have no gap
constexpr JsonRange stiffness = from_to(1e-6, 1e6);  // N mm2; of instruments 0.1 to 10000

}  // namespace

InstrumentKeys::InstrumentKeys(const InstrumentNeeds& needs)
    : needs_(needs),
      instrument_{
          "instrument",
          {{"name", true, "what people call it, a text", json_type::text()},
           {"outer_radius_mm", true, "its outer radius in mm, 0.01 to 10", json_type::number(from_to(0.01, 10))},
           {"length_mm", needs.length, "from the distal tip to where it is held in mm, > 0 and at most 10000",
            json_type::number(above_zero_to(10000))},
           {"sections", true, needs.no_gaps ? "sections from the tip backwards, without gaps" : "its sections",
            json_type::list_of(json_type::object("section"), 1)}}},
      section_{
          "section",
          {{"from_tip_mm", true, "two distances from the distal tip in mm, [from, to]", json_type::numbers(2)},
           {"EI_Nmm2", true, "bending stiffness in N mm2, 1e-6 to 1e6", json_type::number(stiffness)},
           {"GJ_Nmm2", needs.torsion, "torsional stiffness in N mm2, 1e-6 to 1e6", json_type::number(stiffness)}}} {}

JsonKey InstrumentKeys::in_set() const {
  return {"instruments", true, "the instrument, one", json_type::list_of(json_type::object("instrument"), 1, 1)};
}

std::vector<const JsonObjectKeys*> InstrumentKeys::with(std::vector<const JsonObjectKeys*> others) const {
  others.push_back(&instrument_), others.push_back(&section_);
  return others;
}

Instrument InstrumentKeys::read(const JsonObject& set) const {
  if (set.list("instruments").size() != 1) set.refuse("instruments");
  const JsonObject entry(set.list("instruments")[0], instrument_);
  entry.text("name");
  Instrument out;
  out.radius_m = entry.positive("outer_radius_mm") * mm;
  if (entry.has("length_mm")) out.length_m = entry.positive("length_mm") * mm;
  double end_mm = 0;
  for (const JsonValue& item : entry.list("sections")) {
    const JsonObject section(item, section_);
    const auto ends = section.numbers("from_tip_mm", 2);
    const bool gap = needs_.no_gaps && std::fabs(ends[0] - end_mm) > touching_mm;
    if (!needs_.no_gaps && ends[0] < end_mm - touching_mm)
      section["from_tip_mm"].refuse(
          fmt::format("a section from {:g} mm on or further, where the one before it ends", end_mm));
    if (gap || !(ends[1] > ends[0]) || ends[0] < 0)
      section["from_tip_mm"].refuse(
          needs_.no_gaps ? fmt::format("a section from {:g} mm on, where the one before it ends", end_mm)
                         : "two distances from the distal tip in mm, the first from 0 and below the second");
    end_mm = ends[1];
    out.sections.push_back({ends[0] * mm, ends[1] * mm, section.positive("EI_Nmm2") * Nmm2,
                            section.has("GJ_Nmm2") ? section.positive("GJ_Nmm2") * Nmm2 : 0});
  }
  if (out.sections.empty()) entry.refuse("sections");
  if (needs_.length && end_mm * mm < out.length_m - touching_mm * mm)
    entry["sections"].refuse(
        fmt::format("sections as far as where it is held, {:g} mm from the tip", out.length_m / mm));
  return out;
}

}  // namespace ostium::data::curves
