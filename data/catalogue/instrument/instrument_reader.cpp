#include "data/catalogue/instrument/instrument_reader.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <stdexcept>

#include "core/base/units.h"
#include "core/model/rod.h"
#include "data/catalogue/instrument/instrument_keys.h"
#include "vascular/treatment/stent.h"

namespace ostium::data {

namespace {

using units::atm;
using units::mm, units::Nmm2, units::per_mm, units::degree;

/// Stores the source of `object` under its path. Groups must have one; entries of a list may.
void keep_source(const JsonObject& object, Instrument& instrument) {
  if (!object.has("source")) return;
  Source source{object.value().path(), object.text("source")};
  // An estimate must give its reason.
  constexpr std::size_t shortest_reason = 10;
  if (source.estimate() && source.citation.size() < std::string("estimate: ").size() + shortest_reason)
    object["source"].refuse(
        fmt::format("\"estimate: \" and the reasoning in at least {} characters, such as \"estimate: as stiff as "
                    "guide-jl4-6f, whose wall it has\"",
                    shortest_reason));
  instrument.sources.push_back(std::move(source));
}

/// [from, to] of a list entry, which must start at `reached_mm`, the end of the entry before. Advances `reached_mm`.
std::pair<double, double> next_stretch(const JsonObject& entry, double length_mm, double& reached_mm) {
  const std::vector<double> ends = entry.numbers("from_tip_mm", 2);
  if (std::fabs(ends[0] - reached_mm) > gap_tolerance_mm)
    entry["from_tip_mm"].refuse(
        fmt::format("it to begin at {} mm, where the one before it ends (no gap, no overlap)", reached_mm));
  if (!(ends[1] > ends[0]) || ends[1] > length_mm + gap_tolerance_mm) entry.refuse("from_tip_mm");
  reached_mm = ends[1];
  return {ends[0] * mm, ends[1] * mm};
}

/// Checks that a list read with `next_stretch` reached the proximal end.
void require_whole_length(const JsonObject& group, double reached_mm, double length_mm) {
  if (std::fabs(reached_mm - length_mm) > gap_tolerance_mm)
    group["list"].fail(fmt::format("{} ends {} mm from the tip; expected {} mm, size.length_mm", group["list"].path(),
                                   reached_mm, length_mm));
}

void read_size(const JsonObject& size, Instrument& instrument) {
  instrument.outer_diameter_m = size.positive("outer_diameter_mm") * mm;
  instrument.inner_diameter_m = size.not_negative("inner_diameter_mm") * mm;
  instrument.length_m = size.positive("length_mm") * mm;
  const bool wire = instrument.kind == InstrumentKind::wire;
  if (instrument.inner_diameter_m >= instrument.outer_diameter_m || wire != (instrument.inner_diameter_m == 0))
    size.refuse("inner_diameter_mm");
  instrument.passes_m = instrument.inner_diameter_m;
  instrument.needs_m = instrument.outer_diameter_m;
}

core::BendingCurve read_curve(const JsonObject& entry) {
  const JsonObject table(entry["moment_curvature"], instrument_keys::moment_curvature);
  const std::vector<JsonValue>& curvature = table.list("curvature_per_mm");
  core::BendingCurve out;
  if (curvature.empty() || curvature.size() > core::BendingCurve::most) table.refuse("curvature_per_mm");
  out.knots = static_cast<int>(curvature.size());
  const std::vector<double> at = table.numbers("curvature_per_mm", curvature.size()),
                            tangent = table.numbers("tangent", curvature.size());
  for (int j = 0; j < out.knots; ++j) {
    out.curvature_per_m[j] = at[j] * per_mm, out.tangent[j] = tangent[j];
    if (!(at[j] > (j > 0 ? at[j - 1] : 0))) table.refuse("curvature_per_mm");
    if (!(tangent[j] >= 0.01 && tangent[j] <= 100)) table.refuse("tangent");
  }
  return out;
}

constexpr double densest_kg_m3 = 22'590;                      ///< osmium: Arblaster 2014, Platinum Metals Rev 58:137
constexpr double stiffest_Pa = 1.2e12, stiffest_G_Pa = 6e11;  ///< diamond [rounded up, from memory]

core::Section read_section(const JsonObject& entry, const Instrument& instrument, double& reached_mm) {
  core::Section s;
  std::tie(s.from_tip_m, s.to_tip_m) = next_stretch(entry, instrument.length_m / mm, reached_mm);
  const bool one = entry.has("EI_Nmm2"), first = entry.has("EI1_Nmm2"), second = entry.has("EI2_Nmm2");
  if (one == first || first != second)
    entry.value().fail(
        fmt::format("{} has {} of the bending stiffnesses; expected EI_Nmm2, or both EI1_Nmm2 and EI2_Nmm2",
                    entry.value().path(), one + first + second));
  s.EI1_N_m2 = entry.positive(one ? "EI_Nmm2" : "EI1_Nmm2") * Nmm2;
  s.EI2_N_m2 = entry.positive(one ? "EI_Nmm2" : "EI2_Nmm2") * Nmm2;
  s.GJ_N_m2 = entry.positive("GJ_Nmm2") * Nmm2;
  s.kg_per_m = entry.positive("kg_per_m");
  double outer = instrument.outer_diameter_m, inner = instrument.inner_diameter_m;
  if (entry.has("outer_diameter_mm")) outer = entry.positive("outer_diameter_mm") * mm;
  if (outer > instrument.outer_diameter_m) entry.refuse("outer_diameter_mm");
  if (entry.has("inner_diameter_mm")) inner = entry.not_negative("inner_diameter_mm") * mm;
  if (inner >= outer) entry.refuse(entry.has("inner_diameter_mm") ? "inner_diameter_mm" : "outer_diameter_mm");
  s.radius_m = outer / 2, s.inner_radius_m = inner / 2;
  if (s.kg_per_m > densest_kg_m3 * std::numbers::pi / 4 * (outer * outer - inner * inner)) entry.refuse("kg_per_m");
  const double second_moment_m4 = std::numbers::pi / 64 * (std::pow(outer, 4) - std::pow(inner, 4));
  const auto too_stiff = [&](double EI_N_m2) { return EI_N_m2 > stiffest_Pa * second_moment_m4; };
  if (too_stiff(s.EI1_N_m2)) entry.refuse(one ? "EI_Nmm2" : "EI1_Nmm2");
  if (too_stiff(s.EI2_N_m2)) entry.refuse(one ? "EI_Nmm2" : "EI2_Nmm2");
  if (s.GJ_N_m2 > stiffest_G_Pa * 2 * second_moment_m4) entry.refuse("GJ_Nmm2");
  if (entry.has("rest_curvature_per_mm")) {
    const std::vector<double> u = entry.numbers("rest_curvature_per_mm", 3);
    s.rest_curvature_per_m = Eigen::Vector3d(u[0], u[1], u[2]) * per_mm;
  }
  if (entry.has("softening_per_mm") != entry.has("softened_ratio"))
    entry.refuse(entry.has("softening_per_mm") ? "softening_per_mm" : "softened_ratio");
  if (entry.has("softening_per_mm")) {
    s.softening_per_m = entry.positive("softening_per_mm") * per_mm;
    s.softened_ratio = entry.positive("softened_ratio");
    if (s.softened_ratio > 1 || s.softened_ratio < 0.01) entry.refuse("softened_ratio");
  }
  if (entry.has("moment_curvature")) {
    if (entry.has("softening_per_mm")) entry.refuse("moment_curvature");
    s.bending = read_curve(entry);
  }
  return s;
}

core::Relaxation read_relaxation(const JsonObject& group) {
  core::Relaxation out;
  if (group.list("relaxation").empty() || group.list("relaxation").size() > std::size(out.branches))
    group.refuse("relaxation");
  double sum = 0;
  for (std::size_t k = 0; k < group.list("relaxation").size(); ++k) {
    const JsonObject branch(group.list("relaxation")[k], instrument_keys::relaxation_branch);
    out.branches[k] = {branch.positive("fraction"), branch.positive("time_s")};
    sum += out.branches[k].fraction;
    if (!(sum < 1)) branch.refuse("fraction");
  }
  return out;
}

void read_sections(const JsonObject& group, Instrument& instrument) {
  keep_source(group, instrument);
  if (group.list("list").empty()) group.refuse("list");
  double reached_mm = 0;
  for (const JsonValue& value : group.list("list")) {
    const JsonObject entry(value, instrument_keys::section);
    keep_source(entry, instrument);
    instrument.sections.push_back(read_section(entry, instrument, reached_mm));
    const core::Section& s = instrument.sections.back();
    StiffnessError error{s.from_tip_m, s.to_tip_m, 0, 0};
    if (entry.has("EI_sigma_Nmm2")) error.EI_N_m2 = entry.positive("EI_sigma_Nmm2") * Nmm2;
    if (entry.has("GJ_sigma_Nmm2")) error.GJ_N_m2 = entry.positive("GJ_sigma_Nmm2") * Nmm2;
    if (error.EI_N_m2 > 0 || error.GJ_N_m2 > 0) instrument.stiffness_errors.push_back(error);
  }
  require_whole_length(group, reached_mm, instrument.length_m / mm);
  if (group.has("relaxation")) instrument.relaxation = read_relaxation(group);
}

std::vector<ShapePiece> read_pieces(const JsonObject& group, double longest_m, const Instrument& instrument) {
  std::vector<ShapePiece> pieces;
  for (const JsonValue& value : group.list("pieces")) {
    const JsonObject piece(value, instrument_keys::piece);
    if (piece.has("name")) piece.text("name");
    ShapePiece read{.length_m = piece.positive("length_mm") * mm};
    if (piece.has("radius_mm") != piece.has("plane_deg"))
      piece.refuse(piece.has("radius_mm") ? "radius_mm" : "plane_deg");
    if (piece.has("radius_mm")) {
      read.radius_m = piece.positive("radius_mm") * mm;
      if (read.radius_m < instrument.outer_diameter_m / 2) piece.refuse("radius_mm");
      if (!(std::fabs(piece.number("plane_deg")) <= 360)) piece.refuse("plane_deg");
      read.plane_rad = piece.number("plane_deg") * degree;
    }
    pieces.push_back(read);
  }
  if (pieces.empty() || length_of(pieces) > longest_m + gap_tolerance_mm * mm) group.refuse("pieces");
  return pieces;
}

/// The preformed shape, or the default shape of a shapeable tip; also applied to the sections.
void read_rest_shape(const JsonObject& root, Instrument& instrument) {
  if (root.has("shape")) {
    for (const core::Section& s : instrument.sections)
      if (!s.rest_curvature_per_m.isZero()) root.refuse("shape");
    if (root.has("shapeable_tip")) root.refuse("shape");
    const JsonObject shape(root["shape"], instrument_keys::shape);
    keep_source(shape, instrument);
    instrument.shape = read_pieces(shape, instrument.length_m, instrument);
    if (shape.has("width_mm")) instrument.width_m = shape.positive("width_mm") * mm;
    instrument.sections = bent(instrument.sections, instrument.shape);
  }
  if (root.has("shapeable_tip")) {
    if (instrument.kind != InstrumentKind::wire) root.refuse("shapeable_tip");
    const JsonObject tip(root["shapeable_tip"], instrument_keys::shapeable_tip);
    keep_source(tip, instrument);
    ShapeableTip read{.length_m = tip.positive("length_mm") * mm, .default_shape = {}};
    if (read.length_m > instrument.length_m) tip.refuse("length_mm");
    read.default_shape = read_pieces(tip, read.length_m, instrument);
    instrument.shapeable_tip = std::move(read);
    instrument = with_tip_shape(instrument, instrument.shapeable_tip->default_shape);
  }
}

OpaqueMaterial read_material(const JsonObject& object) {
  return static_cast<OpaqueMaterial>(object.choice("material", opaque_materials()));
}

void read_radiopacity(const JsonObject& group, Instrument& instrument) {
  keep_source(group, instrument);
  double reached_mm = 0;
  for (const JsonValue& value : group.list("list")) {
    const JsonObject entry(value, instrument_keys::stretch);
    keep_source(entry, instrument);
    const auto [from, to] = next_stretch(entry, instrument.length_m / mm, reached_mm);
    const double thickness_m = entry.not_negative("thickness_mm") * mm;
    if (thickness_m > std::numbers::pi / 4 * instrument.outer_diameter_m) entry.refuse("thickness_mm");
    instrument.opaque.push_back({from, to, read_material(entry), thickness_m});
  }
  require_whole_length(group, reached_mm, instrument.length_m / mm);
}

void read_markers(const JsonObject& group, Instrument& instrument) {
  keep_source(group, instrument);
  for (const JsonValue& value : group.list("list")) {
    const JsonObject entry(value, instrument_keys::marker);
    keep_source(entry, instrument);
    Marker marker{.from_tip_m = entry.not_negative("from_tip_mm") * mm,
                  .length_m = entry.positive("length_mm") * mm,
                  .material = read_material(entry),
                  .thickness_m = entry.positive("thickness_mm") * mm};
    if (entry.has("outer_diameter_mm")) {
      marker.outer_diameter_m = entry.positive("outer_diameter_mm") * mm;
      if (*marker.outer_diameter_m > instrument.outer_diameter_m)
        entry["outer_diameter_mm"].refuse(
            fmt::format("at most the instrument's {} mm", instrument.outer_diameter_m / mm));
      if (marker.thickness_m > std::numbers::pi / 4 * *marker.outer_diameter_m)
        entry["thickness_mm"].refuse("at most pi/4 of the band's outer diameter");
    }
    if (marker.from_tip_m + marker.length_m > instrument.length_m)
      entry["from_tip_mm"].refuse(
          fmt::format("a band that ends within the instrument's {} mm", instrument.length_m / mm));
    instrument.markers.push_back(marker);
  }
}

void read_wire_lumen(const JsonObject& group, Instrument& instrument) {
  keep_source(group, instrument);
  WireLumen lumen;
  lumen.rapid_exchange = group.choice("system", {"rapid_exchange", "over_the_wire"}) == 0;
  lumen.length_m = instrument.length_m;
  if (group.has("length_mm")) {
    lumen.length_m = group.positive("length_mm") * mm;
    if (!lumen.rapid_exchange || lumen.length_m > instrument.length_m) group.refuse("length_mm");
  } else if (lumen.rapid_exchange) {
    group["system"].refuse("length_mm beside it: from the tip to the wire's port");
  }
  instrument.wire_lumen = lumen;
}

double within(const JsonObject& object, const std::string& key, double least, double most) {
  const double value = object.number(key);
  if (!(value >= least && value <= most)) object.refuse(key);
  return value;
}

template <class Design>
void read_design_numbers(const JsonObject& design, const std::vector<DesignNumber<Design>>& table, Design& out) {
  for (const DesignNumber<Design>& row : table)
    if (design.has(row.key)) out.*row.member = within(design, row.key, row.least, row.most) * row.unit;
}

void read_balloon_design(const JsonObject& design, Instrument& instrument, CarriedBalloon& balloon) {
  keep_source(design, instrument);
  read_design_numbers(design, balloon_design_numbers, balloon.design);
  balloon.own_folds = design.has("folded_radius_mm");
  if (balloon.own_folds != design.has("refolded_radius_mm"))
    design.value().fail(design.value().path() + " has one of folded_radius_mm and refolded_radius_mm; expected both");
}

void read_stent_design(const JsonObject& design, Instrument& instrument, CarriedStent& stent) {
  keep_source(design, instrument);
  for (const StentCount& row : stent_design_counts) {
    if (!design.has(row.key)) continue;
    const double count = within(design, row.key, row.least, row.most);
    if (count != std::floor(count)) design.refuse(row.key);
    stent.design.*row.member = static_cast<int>(count);
  }
  read_design_numbers(design, stent_design_numbers, stent.design);
  try {
    make_stent(stent.nominal_m, stent.length_m, stent.design);
  } catch (const std::invalid_argument& error) {
    design.value().fail(fmt::format("{} makes no stent: {}", design.value().path(), error.what()));
  }
}

void read_balloon(const JsonObject& group, Instrument& instrument) {
  keep_source(group, instrument);
  CarriedBalloon balloon;
  balloon.nominal_m = within(group, "nominal_diameter_mm", 1, 8) * mm;
  balloon.length_m = within(group, "length_mm", 5, 60) * mm;
  balloon.compliant = group.choice("compliance", {"semi", "non"}) == 0;
  balloon.nominal_Pa = group.positive("nominal_atm") * atm;
  balloon.rated_Pa = within(group, "rated_atm", group.number("nominal_atm"), 30) * atm;
  // Its length must agree with its markers, since its position is read from them.
  const std::vector<Marker>& bands = instrument.markers;
  if (bands.size() != 2) group.value().fail("balloon lies between two markers; expected markers with two bands");
  const double apart =
      std::fabs(bands[1].from_tip_m + bands[1].length_m / 2 - bands[0].from_tip_m - bands[0].length_m / 2);
  if (std::fabs(apart - balloon.length_m) > 1.1 * mm) group.refuse("length_mm");
  if (group.has("design"))
    read_balloon_design(JsonObject(group["design"], instrument_keys::balloon_design), instrument, balloon);
  instrument.balloon = balloon;
}

void read_stent(const JsonObject& group, Instrument& instrument) {
  keep_source(group, instrument);
  CarriedStent stent;
  stent.nominal_m = within(group, "nominal_diameter_mm", 1, 8) * mm;
  stent.length_m = within(group, "length_mm", 5, 60) * mm;
  if (stent.length_m > instrument.balloon->length_m + 0.01 * mm) group.refuse("length_mm");
  if (group.has("design"))
    read_stent_design(JsonObject(group["design"], instrument_keys::stent_design), instrument, stent);
  instrument.stent = stent;
}

void read_clearance(const JsonObject& group, Instrument& instrument) {
  keep_source(group, instrument);
  if (!group.has("passes_mm") && !group.has("needs_mm"))
    group.value().fail("clearance has no number; expected passes_mm, needs_mm or both");
  if (group.has("passes_mm")) {
    instrument.passes_m = group.positive("passes_mm") * mm;
    if (instrument.passes_m > instrument.inner_diameter_m) group.refuse("passes_mm");
  }
  if (group.has("needs_mm")) {
    instrument.needs_m = group.positive("needs_mm") * mm;
    if (instrument.needs_m < instrument.outer_diameter_m) group.refuse("needs_mm");
  }
}

MeasuredFriction read_friction(const JsonObject& group, Instrument& instrument) {
  keep_source(group, instrument);
  return {group.positive("coefficient"), group.positive("sigma")};
}

/// Core has limits of its own, for numbers of the right sign that no instrument has.
void require_rod(const JsonObject& root, const Instrument& instrument) {
  try {
    check(rod_description(instrument, equal_elements(instrument.sections, 64)));
  } catch (const std::invalid_argument& error) {
    root["sections"].fail(std::string("sections make no rod: ") + error.what());
  }
}

Instrument instrument_of(const JsonValue& file) {
  const JsonObject root(file, instrument_keys::instrument);
  Instrument instrument;
  if (root.text("schema") != "ostium-instrument/1") root.refuse("schema");
  instrument.name = root.text("name");
  if (instrument.name != std::filesystem::path(*file.file).stem().string()) root.refuse("name");
  instrument.title = root.text("title");
  instrument.kind = static_cast<InstrumentKind>(root.choice("kind", instrument_kinds()));

  const JsonObject size(root["size"], instrument_keys::size);
  keep_source(size, instrument);
  read_size(size, instrument);
  read_sections(JsonObject(root["sections"], instrument_keys::sections), instrument);
  read_rest_shape(root, instrument);
  read_radiopacity(JsonObject(root["radiopacity"], instrument_keys::radiopacity), instrument);
  if (root.has("markers")) read_markers(JsonObject(root["markers"], instrument_keys::markers), instrument);

  const bool shaft = instrument.kind == InstrumentKind::balloon_shaft || instrument.kind == InstrumentKind::stent_shaft;
  if (shaft && !root.has("wire_lumen"))
    root["kind"].refuse("a wire_lumen with it: how a " + words_for(instrument.kind) + " runs over its wire");
  if (root.has("wire_lumen")) {
    if (!shaft) root.refuse("wire_lumen");
    read_wire_lumen(JsonObject(root["wire_lumen"], instrument_keys::wire_lumen), instrument);
  }
  const bool carries_stent = instrument.kind == InstrumentKind::stent_shaft;
  for (const char* key : {"balloon", "stent"}) {
    const bool needed = shaft && (key[0] == 'b' || carries_stent);
    if (needed && !root.has(key)) root["kind"].refuse(fmt::format("a {} with it: what it carries", key));
    if (!needed && root.has(key)) root.refuse(key);
  }
  if (root.has("friction"))
    instrument.friction = read_friction(JsonObject(root["friction"], instrument_keys::friction), instrument);
  if (root.has("balloon")) read_balloon(JsonObject(root["balloon"], instrument_keys::balloon), instrument);
  if (root.has("stent")) read_stent(JsonObject(root["stent"], instrument_keys::stent), instrument);
  if (root.has("clearance")) read_clearance(JsonObject(root["clearance"], instrument_keys::clearance), instrument);
  require_rod(root, instrument);
  return instrument;
}

}  // namespace

Instrument read_instrument(const std::string& file, const std::string& text) {
  return instrument_of(parse_json(file, text));
}

Instrument load_instrument(const std::string& file) { return instrument_of(load_json(file)); }

}  // namespace ostium::data
