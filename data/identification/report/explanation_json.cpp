#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/units.h"
#include "data/identification/report/explanation_report.h"

namespace ostium::data {

namespace {

using Json = nlohmann::ordered_json;
using units::mm;

Json or_null(const std::optional<double>& value, double unit = 1) {
  return value ? Json(*value / unit) : Json(nullptr);
}

Json parameters(const FittedModel& m, bool units) {
  Json out = Json::object();
  for (const FittedParameter& p : m.parameters) {
    out[p.parameter.name] = {{"value", p.value}, {"sigma", p.sigma}};
    if (units) out[p.parameter.name]["unit"] = p.parameter.unit;
  }
  return out;
}

Json rms_of(const FittedModel& m, const MisfitUnit& unit) {
  Json out = {{"fit", m.rms_m / unit.size}, {"held_out", or_null(m.rms_held_out_m, unit.size)}};
  if (m.push_rms_N) out["push_fit_N"] = *m.push_rms_N, out["push_held_out_N"] = or_null(m.push_rms_held_out_N);
  return out;
}

Json signature(const Signature& s) {
  Json out = {{"frame", s.frame}, {"from_tip_mm", nullptr}, {"at_mm", nullptr}};
  if (s.from_tip_m) out["from_tip_mm"] = {s.from_tip_m->x() / mm, s.from_tip_m->y() / mm};
  if (s.at_m) out["at_mm"] = {s.at_m->x() / mm, s.at_m->y() / mm, s.at_m->z() / mm};
  return out;
}

Json next(const std::optional<NextExperiment>& n, const MisfitUnit& unit) {
  if (!n) return nullptr;
  Json set = Json::array();
  for (const Placement& p : n->set)
    set.push_back({{"inserted_length_mm", p.inserted_m / mm},
                   {"roll_deg", p.roll_rad * 180 / units::pi},
                   {"shaft_mm", p.shaft_m / mm}});
  return {{"why", n->why}, {"set", set}, {"predicted_difference_" + unit.name, n->difference_m / unit.size}};
}

}  // namespace

std::string to_json(const Explanation& x) {
  Json out = {{"schema", "ostium-explanation/1"}, {"verdict", to_string(x.verdict)}, {"ended_early", x.ended_early}};
  out["declared"] = {{"parameters", parameters(x.declared, false)},
                     {"rms", rms_of(x.declared, x.unit)},
                     {"unit", x.unit.name},
                     {"noise_sigma_" + x.unit.name, or_null(x.noise.sigma_m, x.unit.size)},
                     {"chi2_per_dof", or_null(x.declared.chi2_per_dof)}};
  const bool won = x.verdict == Verdict::effect;
  out["effects"] = won ? Json(x.best().effects) : Json::array();
  out["candidates"] = Json::array();
  for (const FittedModel& c : x.candidates)
    out["candidates"].push_back({{"effects", c.effects},
                                 {"parameters", parameters(c, true)},
                                 {"rms", rms_of(c, x.unit)},
                                 {"chi2_per_dof", or_null(c.chi2_per_dof)},
                                 {"delta_bic", c.bic - x.declared.bic}});
  out["after"] = nullptr;
  if (won)
    out["after"] = {{"parameters", parameters(x.best(), true)},
                    {"rms", rms_of(x.best(), x.unit)},
                    {"chi2_per_dof", or_null(x.best().chi2_per_dof)}};
  out["signature"] = signature(x.signature);
  out["next_experiment"] = next(x.next_experiment, x.unit);
  return out.dump(1) + "\n";
}

std::string amended(const std::string& text, const MeasurementSet& set, const Explanation& x) {
  Json file = Json::parse(written_out(text, set));
  const FittedModel& m = x.best();
  for (std::size_t i = 0; i < set.instruments.size(); ++i)
    for (std::size_t s = 0; s < set.instruments[i].sections.size(); ++s) {
      Json& section = file["instruments"][i]["sections"][s];
      for (const char* key : {"EI_Nmm2", "GJ_Nmm2"})
        section[key] = section[key].get<double>() * m.changes.stiffness_scale[i][s];
    }
  Json effects = Json::array();
  for (const ActiveEffect& e : m.changes.effects) {
    Json values = Json::object();
    for (std::size_t p = 0; p < e.values.size(); ++p) values[e.effect->parameters[p].name] = e.values[p];
    effects.push_back({{"id", e.effect->id},
                       {"instrument", e.instrument ? Json(*e.instrument) : Json(nullptr)},
                       {"parameters", values}});
  }
  if (!effects.empty()) file["effects"] = effects;
  return file.dump(1) + "\n";
}

}  // namespace ostium::data
