#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/units.h"
#include "data/identification/effects/tools.h"
#include "data/identification/forward/setup.h"
#include "data/identification/report/explanation_report.h"

namespace ostium::data {

namespace {

using Json = nlohmann::ordered_json;

using units::mm, units::Nmm2;
constexpr double weight_length_m = 2e-3;

/// Converts the text to a valid file name.
std::string file_name(const std::string& words) {
  std::string out;
  for (const char c : words) {
    if (std::isalnum(static_cast<unsigned char>(c)))
      out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (!out.empty() && out.back() != '-')
      out += '-';
  }
  while (!out.empty() && out.back() == '-') out.pop_back();
  return out.empty() ? "instrument" : out;
}

Json section(const core::Section& s) {
  Json out = {{"from_tip_mm", {s.from_tip_m / mm, s.to_tip_m / mm}}};
  if (s.EI1_N_m2 == s.EI2_N_m2)
    out["EI_Nmm2"] = s.EI1_N_m2 / Nmm2;
  else
    out["EI1_Nmm2"] = s.EI1_N_m2 / Nmm2, out["EI2_Nmm2"] = s.EI2_N_m2 / Nmm2;
  out["GJ_Nmm2"] = s.GJ_N_m2 / Nmm2;
  out["kg_per_m"] = s.kg_per_m;
  if (!s.rest_curvature_per_m.isZero())
    out["rest_curvature_per_mm"] = {s.rest_curvature_per_m.x() * mm, s.rest_curvature_per_m.y() * mm,
                                    s.rest_curvature_per_m.z() * mm};
  if (s.softening_per_m > 0 && s.softened_ratio < 1)
    out["softening_per_mm"] = s.softening_per_m * mm, out["softened_ratio"] = s.softened_ratio;
  if (!s.bending.linear()) {
    Json& curve = out["moment_curvature"];
    for (int j = 0; j < s.bending.knots; ++j)
      curve["curvature_per_mm"].push_back(s.bending.curvature_per_m[j] * mm),
          curve["tangent"].push_back(s.bending.tangent[j]);
  }
  return out;
}

/// Relaxation branches of an instrument that has a rest shape to lose.
Json relaxation(const std::vector<ActiveEffect>& effects, const std::vector<core::Section>& sections, std::size_t i) {
  Json out = Json::array();
  if (std::all_of(sections.begin(), sections.end(),
                  [](const core::Section& s) { return s.rest_curvature_per_m.isZero(); }))
    return out;
  for (const ActiveEffect& e : effects) {
    if (e.effect->id != "stress_relaxation" || (e.instrument && *e.instrument != static_cast<int>(i))) continue;
    for (const int k : {0, 2})
      if (e.values[k] > 0) out.push_back({{"fraction", e.values[k]}, {"time_s", e.values[k + 1]}});
  }
  return out;
}

}  // namespace

std::string instrument_json(const MeasurementSet& as_read, const Explanation& x, std::size_t i,
                            const std::string& name) {
  const MeasurementSet& set = x.judged(as_read);
  const MeasuredInstrument& measured = set.instruments[i];
  Changes changes = x.best().changes;
  std::string found;
  std::erase_if(changes.effects, [](const ActiveEffect& e) { return !e.effect->in_instrument; });
  for (const ActiveEffect& e : changes.effects) found += (found.empty() ? " with " : " and ") + e.effect->what;
  // As delivered: relaxation is written separately.
  Experiment fresh = set.experiments.front();
  if (fresh.elapsed_s) fresh.elapsed_s = 0;
  std::vector<core::Section> sections = setup_of(set, fresh, changes).nest.parts[i].sections;
  const Json lost = relaxation(changes.effects, sections, i);
  for (const ActiveEffect& e : changes.effects)
    if (e.effect->id == "lumped_mass" && i + 1 == set.instruments.size()) {
      const double grams = e.values[0], from = std::max(e.values[1] * mm - weight_length_m / 2, 0.0);
      change_stretch(sections, from, from + weight_length_m,
                     [&](core::Section& s) { s.kg_per_m += grams * 1e-3 / weight_length_m; });
    }
  const double outer = 2 * measured.radius_m, inner = 2 * measured.inner_radius_m;
  const double metal = units::pi / 4 * (outer * outer - inner * inner) / outer;
  const std::string source = "fitted by ostium explain to \"" + set.title + "\" (" + set.source + ")";
  Json list = Json::array();
  for (const core::Section& s : sections) list.push_back(section(s));
  Json all = {{"list", list}, {"source", source}};
  if (!lost.empty()) all["relaxation"] = lost;
  const Json file = {{"schema", "ostium-instrument/1"},
                     {"name", name.empty() ? file_name(measured.name) : name},
                     {"title", measured.name + found},
                     {"kind", inner > 0 ? "diagnostic_catheter" : "wire"},
                     {"size",
                      {{"outer_diameter_mm", outer / mm},
                       {"inner_diameter_mm", inner / mm},
                       {"length_mm", measured.length_m / mm},
                       {"source", "declared in the measured set \"" + set.title + "\""}}},
                     {"sections", all},
                     {"radiopacity",
                      {{"list",
                        {{{"from_tip_mm", {0.0, measured.length_m / mm}},
                          {"material", inner > 0 ? "polymer" : "nitinol"},
                          {"thickness_mm", metal / mm}}}},
                       {"source", "estimate: a measured set does not say; its whole cross-section of one material"}}}};
  return file.dump(2) + "\n";
}

}  // namespace ostium::data
