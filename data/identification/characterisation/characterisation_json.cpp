#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/units.h"
#include "data/identification/characterisation/characterisation_report.h"

namespace ostium::data {

namespace {

using Json = nlohmann::ordered_json;

using units::mm, units::Nmm2;

std::string names_of(const Characterisation& c, const Combined& number) {
  std::string out;
  for (std::size_t i = 0; i < number.sets.size(); ++i)
    out += (i == 0 ? "" : i + 1 == number.sets.size() ? " and " : ", ") + c.sets[number.sets[i]].name;
  return out;
}

/// "EI 40.1 +- 0.4 N mm2 from bend and hang"; empty if it was not measured.
std::string provenance(const Characterisation& c, const std::string& what, const Combined& number) {
  if (!number.measured()) return "";
  return fmt::format("{} {:.4g} +- {:.2g} N mm2 from {}", what, number.value / Nmm2, number.value * number.sigma / Nmm2,
                     names_of(c, number));
}

/// `entry`, a section of the file, as a stretch of it was measured.
Json measured_section(const Characterisation& c, Json entry, const Stretch& s, const DeclaredStretch& declared) {
  entry["from_tip_mm"] = {s.from_tip_m / mm, s.to_tip_m / mm};
  const auto scaled = [&](const char* key, double factor) {
    if (entry.contains(key)) entry[key] = double(entry[key]) * factor;
  };
  for (const char* key : {"EI_Nmm2", "EI1_Nmm2", "EI2_Nmm2"}) scaled(key, s.EI_N_m2.value / declared.EI_N_m2);
  scaled("GJ_Nmm2", s.GJ_N_m2.value / declared.GJ_N_m2);
  if (s.EI_N_m2.measured()) entry["EI_sigma_Nmm2"] = s.EI_N_m2.value * s.EI_N_m2.sigma / Nmm2;
  if (s.GJ_N_m2.measured()) entry["GJ_sigma_Nmm2"] = s.GJ_N_m2.value * s.GJ_N_m2.sigma / Nmm2;
  const std::string EI = provenance(c, "EI", s.EI_N_m2), GJ = provenance(c, "GJ", s.GJ_N_m2);
  if (EI.empty() && GJ.empty()) return entry;
  std::string source = "measured: " + EI + (EI.empty() || GJ.empty() ? "" : ", ") + GJ;
  if (GJ.empty()) source += "; GJ in the ratio to EI that was declared";
  entry["source"] = source;
  return entry;
}

Json number(const Characterisation& c, const Combined& n, double unit) {
  Json from = Json::array();
  for (std::size_t i = 0; i < n.sets.size(); ++i)
    from.push_back({{"set", c.sets[n.sets[i]].name}, {"off_by_sigma", n.off[i]}});
  return {{"value", n.value / unit},
          {"sigma", n.measured() ? Json(n.value * n.sigma / unit) : Json(nullptr)},
          {"measured", n.measured()},
          {"disagree", n.disagree()},
          {"from", from}};
}

Json as_json(const WireCheck& check) {
  Json runs = Json::array();
  for (const RunCheck& r : check.runs) runs.push_back({{"id", r.id}, {"rms_over_noise", r.over_noise}});
  Json moves = Json::array();
  for (const AskedMove& m : check.moves) moves.push_back({{"what", m.what}, {"errors", m.errors}});
  return {{"rms_over_noise", check.over_noise},
          {"beyond_errors", check.beyond_errors},
          {"asked_moves", moves},
          {"agrees_within", agrees_within},
          {"agrees_within_errors", agrees_within_errors},
          {"agrees", check.agrees()},
          {"runs", runs}};
}

}  // namespace

std::string instrument_json(const Characterisation& c, const std::string& name) {
  Json file = Json::parse(c.like);
  const Json before = file["sections"]["list"];
  Json list = Json::array();
  for (const Stretch& s : c.wire.stretches) {
    std::size_t k = 0;
    while (c.declared[k].to_tip_m < (s.from_tip_m + s.to_tip_m) / 2) ++k;
    list.push_back(measured_section(c, before[k], s, c.declared[k]));
  }
  file["name"] = name;
  file["sections"]["list"] = std::move(list);
  if (c.wire.friction.measured()) {
    const Combined& n = c.wire.friction;
    file["friction"] = {{"coefficient", n.value},
                        {"sigma", n.value * n.sigma},
                        {"source", "measured: on the benches of " + names_of(c, n)}};
  }
  return file.dump(2) + "\n";
}

CharacterisedWire wire_in(const Instrument& instrument) {
  const auto number = [](double value, double sigma) {
    Combined n;
    n.value = value;
    if (sigma > 0) n.sigma = sigma / value, n.sets = {0};
    return n;
  };
  CharacterisedWire out;
  for (const core::Section& s : instrument.sections) {
    StiffnessError error;
    for (const StiffnessError& e : instrument.stiffness_errors)
      if (e.from_tip_m <= s.from_tip_m && s.from_tip_m < e.to_tip_m) error = e;
    out.stretches.push_back({s.from_tip_m, s.to_tip_m, number(0.5 * (s.EI1_N_m2 + s.EI2_N_m2), error.EI_N_m2),
                             number(s.GJ_N_m2, error.GJ_N_m2)});
  }
  if (instrument.friction) out.friction = number(instrument.friction->coefficient, instrument.friction->sigma);
  return out;
}

std::string to_json(const Characterisation& c) {
  Json sets = Json::array(), stretches = Json::array();
  for (const CharacterisedSet& s : c.sets)
    sets.push_back({{"name", s.name},
                    {"kind", s.root.find("kind") ? Json(s.root.find("kind")->text) : Json("centrelines")},
                    {"verdict", to_string(s.verdict())},
                    {"effects", s.effects()},
                    {"why_unused", s.used() ? Json(nullptr) : Json(s.why_unused)},
                    {"predicted_by_the_others", s.check ? as_json(*s.check) : Json(nullptr)}});
  for (const Stretch& s : c.wire.stretches)
    stretches.push_back({{"from_tip_mm", {s.from_tip_m / mm, s.to_tip_m / mm}},
                         {"EI_Nmm2", number(c, s.EI_N_m2, Nmm2)},
                         {"GJ_Nmm2", number(c, s.GJ_N_m2, Nmm2)}});
  const Json friction = c.wire.friction.measured() ? number(c, c.wire.friction, 1) : Json(nullptr);
  return Json{{"schema", "ostium-characterisation/1"},
              {"sets", sets},
              {"stretches", stretches},
              {"friction", friction},
              {"text", c.text}}
             .dump(1) +
         "\n";
}

std::string words_of(const WireCheck& check) {
  std::string out =
      fmt::format("{:.2f} times the noise, {:.2f} beyond what the errors of its stiffness and friction may do",
                  check.over_noise, check.beyond_errors);
  if (!check.moves.empty())
    out += fmt::format("; it would have {} otherwise by {:+.1f} standard errors", check.moves[0].what,
                       check.moves[0].errors);
  return out + (check.agrees() ? ": it agrees" : ": it does not agree") +
         fmt::format(" (the limits are {:g} and {:g})", agrees_within, agrees_within_errors);
}

std::string to_json(const WireCheck& check) {
  Json out = {{"schema", "ostium-check/1"}};
  out.update(as_json(check));
  return out.dump(1) + "\n";
}

}  // namespace ostium::data
