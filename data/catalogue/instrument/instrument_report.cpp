#include "data/catalogue/instrument/instrument_report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/units.h"

namespace ostium::data {

namespace {

/// Prints numbers that round to zero in four digits without a sign.
double unsigned_zero(double x) { return std::fabs(x) < 5e-5 ? 0.0 : x; }

using units::inch, units::degree;
constexpr double m_in_mm = 1e3, N_m2_in_N_mm2 = 1e6;

std::string shape_text(const ShapePiece& piece) {
  if (piece.radius_m == 0) return fmt::format("{:.4g} mm straight", piece.length_m * m_in_mm);
  return fmt::format("{:.0f} degrees of {:.4g} mm radius, plane {:g}", piece.length_m / piece.radius_m / degree,
                     piece.radius_m * m_in_mm, piece.plane_rad / degree);
}

std::string shape_lines(const std::vector<ShapePiece>& pieces) {
  std::string lines;
  for (const ShapePiece& piece : pieces) lines += "  " + shape_text(piece) + "\n";
  return lines;
}

std::string material_name(OpaqueMaterial material) { return opaque_materials().at(static_cast<std::size_t>(material)); }

}  // namespace

double EI_Nmm2(const core::Section& section) { return 0.5 * (section.EI1_N_m2 + section.EI2_N_m2) * N_m2_in_N_mm2; }

std::string nominal_size(const Instrument& i) {
  switch (i.kind) {
    case InstrumentKind::wire:
      return fmt::format("{:.3f} in", i.outer_diameter_m / inch);
    case InstrumentKind::sheath:
      return fmt::format("{:.0f}F inside", 3 * i.passes_m * m_in_mm);
    case InstrumentKind::balloon_shaft:
    case InstrumentKind::stent_shaft:
      return fmt::format("{:.2f} mm", i.outer_diameter_m * m_in_mm);
    default:
      return fmt::format("{:.0f}F", 3 * i.outer_diameter_m * m_in_mm);
  }
}

std::string instrument_heading() {
  return fmt::format("{:<24} {:<20} {:<9} {:>7} {:>9} {:>9}  {}", "name", "kind", "size", "length", "EI tip",
                     "EI shaft", "numbers\n") +
         fmt::format("{:<24} {:<20} {:<9} {:>7} {:>9} {:>9}  {}", "", "", "", "cm", "N mm2", "N mm2", "from");
}

std::string instrument_line(const Instrument& i) {
  return fmt::format("{:<24} {:<20} {:<9} {:>7.4g} {:>9.3g} {:>9.4g}  {}", i.name, words_for(i.kind), nominal_size(i),
                     i.length_m * 100, EI_Nmm2(i.sections.front()), EI_Nmm2(i.sections.back()), source_mark(i));
}

std::string instrument_details(const Instrument& i) {
  std::string out = fmt::format("{}: {} ({})\n", i.name, i.title, words_for(i.kind));
  out += fmt::format("outer diameter {:.3f} mm ({:.4f} in), lumen {:.3f} mm, length {:.4g} cm\n",
                     i.outer_diameter_m * m_in_mm, i.outer_diameter_m / inch, i.inner_diameter_m * m_in_mm,
                     i.length_m * 100);
  out += fmt::format("goes through {:.3f} mm", i.needs_m * m_in_mm);
  if (i.passes_m > 0) out += fmt::format("; lets {:.3f} mm through", i.passes_m * m_in_mm);
  if (i.wire_lumen && i.wire_lumen->rapid_exchange)
    out += fmt::format("; rapid exchange, {:.4g} mm over the wire", i.wire_lumen->length_m * m_in_mm);
  else if (i.wire_lumen)
    out += "; over the wire";
  out += fmt::format("\n\n{:>16} {:>9} {:>9} {:>8} {:>8}  {}\n", "from the tip, mm", "EI N mm2", "GJ N mm2", "g/m",
                     "out. mm", "rest curvature, 1/mm");
  for (const core::Section& s : i.sections) {
    const Eigen::Vector3d u = s.rest_curvature_per_m / m_in_mm;
    out += fmt::format("{:>7.1f} .. {:>6.1f} {:>9.3g} {:>9.3g} {:>8.3g} {:>8.3g}", s.from_tip_m * m_in_mm,
                       s.to_tip_m * m_in_mm, EI_Nmm2(s), s.GJ_N_m2 * N_m2_in_N_mm2, s.kg_per_m * 1e3,
                       2 * s.radius_m * m_in_mm);
    out += u.isZero() ? "\n"
                      : fmt::format("  {:.4f}, {:.4f}, {:.4f}\n", unsigned_zero(u.x()), unsigned_zero(u.y()),
                                    unsigned_zero(u.z()));
  }
  if (!i.stiffness_errors.empty()) out += "\nmeasured, with standard errors, N mm2:\n";
  for (const StiffnessError& e : i.stiffness_errors)
    out += fmt::format("{:>7.1f} .. {:>6.1f}{}{}\n", e.from_tip_m * m_in_mm, e.to_tip_m * m_in_mm,
                       e.EI_N_m2 > 0 ? fmt::format("  EI +- {:.2g}", e.EI_N_m2 * N_m2_in_N_mm2) : "",
                       e.GJ_N_m2 > 0 ? fmt::format("  GJ +- {:.2g}", e.GJ_N_m2 * N_m2_in_N_mm2) : "");
  if (i.friction)
    out += fmt::format("friction on benches {:.3g} +- {:.2g}\n", i.friction->coefficient, i.friction->sigma);
  if (!i.shape.empty()) out += "\nshape at rest, from the tip:\n" + shape_lines(i.shape);
  if (i.width_m > 0) out += fmt::format("  {:.4g} mm from the shaft to the tip\n", i.width_m * m_in_mm);
  if (i.shapeable_tip)
    out += fmt::format("\nthe distal {:.4g} mm can be shaped; as it comes, from the tip:\n",
                       i.shapeable_tip->length_m * m_in_mm) +
           shape_lines(i.shapeable_tip->default_shape);
  out += "\nX-ray:\n";
  for (const OpaqueStretch& s : i.opaque)
    out += fmt::format("  {:.4g} .. {:.4g} mm: {} {:.3g} mm\n", s.from_tip_m * m_in_mm, s.to_tip_m * m_in_mm,
                       material_name(s.material), s.thickness_m * m_in_mm);
  for (const Marker& m : i.markers)
    out += fmt::format("  marker at {:.4g} mm, {:.3g} mm long: {} {:.3g} mm\n", m.from_tip_m * m_in_mm,
                       m.length_m * m_in_mm, material_name(m.material), m.thickness_m * m_in_mm);
  out += "\nsources:\n";
  for (const Source& source : i.sources) out += fmt::format("  {}: {}\n", source.of, source.citation);
  return out;
}

std::string to_json(const std::vector<Instrument>& instruments) {
  auto array = nlohmann::ordered_json::array();
  for (const Instrument& i : instruments) {
    auto sections = nlohmann::ordered_json::array(), sources = nlohmann::ordered_json::array();
    for (const core::Section& s : i.sections) {
      const Eigen::Vector3d u = s.rest_curvature_per_m / m_in_mm;
      sections.push_back({{"from_tip_mm", {s.from_tip_m * m_in_mm, s.to_tip_m * m_in_mm}},
                          {"EI1_Nmm2", s.EI1_N_m2 * N_m2_in_N_mm2},
                          {"EI2_Nmm2", s.EI2_N_m2 * N_m2_in_N_mm2},
                          {"GJ_Nmm2", s.GJ_N_m2 * N_m2_in_N_mm2},
                          {"kg_per_m", s.kg_per_m},
                          {"outer_diameter_mm", 2 * s.radius_m * m_in_mm},
                          {"rest_curvature_per_mm", {u.x(), u.y(), u.z()}}});
    }
    for (const Source& source : i.sources) sources.push_back({{"of", source.of}, {"source", source.citation}});
    array.push_back({{"name", i.name},
                     {"title", i.title},
                     {"kind", instrument_kinds().at(static_cast<std::size_t>(i.kind))},
                     {"outer_diameter_mm", i.outer_diameter_m * m_in_mm},
                     {"inner_diameter_mm", i.inner_diameter_m * m_in_mm},
                     {"length_mm", i.length_m * m_in_mm},
                     {"numbers_from", source_mark(i)},
                     {"sections", std::move(sections)},
                     {"sources", std::move(sources)}});
  }
  return array.dump(2);
}

}  // namespace ostium::data
