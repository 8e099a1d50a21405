#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/units.h"
#include "data/identification/report/explanation_report.h"
#include "data/identification/report/law_report.h"
#include "data/identification/selection/evidence.h"

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

Json number_or_null(const std::optional<double>& x) { return x ? Json(*x) : Json(nullptr); }

/// Of a model, against what the declared one leaves; null where the noise is unknown.
Json share_of(const Explanation& x, const FittedModel& m) {
  if (!x.noise.sigma_m) return nullptr;
  return number_or_null(share_removed(misfit_of(x.declared), misfit_of(m)));
}

Json over_noise(const Explanation& x, const FittedModel& m) {
  return x.noise.sigma_m ? Json(rms_over_noise(misfit_of(m))) : Json(nullptr);
}

Json noise_of(const Explanation& x) {
  const auto& m = x.noise.model;
  return {{"as_declared", x.declared_sigma_m ? Json(!m) : Json(nullptr)},
          {"sigma", or_null(x.noise.sigma_m, x.unit.size)},
          {"correlation_mm", m ? m->length / mm : 0.0},
          {"tail", m && m->heavy() ? "heavy" : "normal"}};
}

/// Added where a model has laws.
void add_laws(const FittedModel& m, Json& out) {
  if (!m.laws.empty()) out["laws"] = json_of(m.laws);
}

Json faults_of(const Explanation& x) {
  Json out = Json::array();
  for (const DataFault& f : x.faults)
    out.push_back(
        {{"id", f.id}, {"experiments", f.experiments}, {"what", f.what}, {"mend", f.mend}, {"told_by", f.told_by}});
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

/// Writes the experiments of a mended set over those of the file, and leaves out those that it lacks.
Json mended_experiments(const Json& list, const MeasurementSet& set) {
  Json out = Json::array();
  for (Json e : list) {
    const auto it = std::find_if(set.experiments.begin(), set.experiments.end(),
                                 [&](const Experiment& x) { return x.id == e["id"].get<std::string>(); });
    if (it == set.experiments.end()) continue;
    for (std::size_t i = 0; i < it->set.size(); ++i)
      e["set"][i]["inserted_length_mm"] = it->set[i].inserted_m / mm,
      e["set"][i]["roll_deg"] = it->set[i].roll_rad / units::degree;
    if (e.contains("tip_force_N")) e["tip_force_N"] = {it->tip_force_N.x(), it->tip_force_N.y(), it->tip_force_N.z()};
    if (e.contains("elapsed_s")) e["elapsed_s"] = *it->elapsed_s;
    if (e.contains("tip_mm"))
      e["tip_mm"] = {it->points_m[0].x() / mm, it->points_m[0].y() / mm, it->points_m[0].z() / mm};
    if (e.contains("radius_of_curvature_mm")) e["radius_of_curvature_mm"] = it->radius_m / mm;
    if (e.contains("centreline_mm")) {
      e["centreline_mm"] = Json::array();
      for (const Eigen::Vector3d& p : it->points_m) e["centreline_mm"].push_back({p.x() / mm, p.y() / mm, p.z() / mm});
    }
    out.push_back(e);
  }
  return out;
}

}  // namespace

std::string to_json(const Explanation& x) {
  Json out = {{"schema", "ostium-explanation/1"}, {"verdict", to_string(x.verdict)}, {"ended_early", x.ended_early}};
  out["declared"] = {{"parameters", parameters(x.declared, false)},
                     {"rms", rms_of(x.declared, x.unit)},
                     {"unit", x.unit.name},
                     {"noise_sigma_" + x.unit.name, or_null(x.noise.sigma_m, x.unit.size)},
                     {"chi2_per_dof", or_null(x.declared.chi2_per_dof)}};
  const bool won = x.verdict == Verdict::effect || x.verdict == Verdict::mostly;
  out["effects"] = x.effects();
  out["faults"] = faults_of(x);
  out["candidates"] = Json::array();
  for (const FittedModel& c : x.candidates) {
    out["candidates"].push_back({{"effects", c.effects},
                                 {"parameters", parameters(c, true)},
                                 {"rms", rms_of(c, x.unit)},
                                 {"chi2_per_dof", or_null(c.chi2_per_dof)},
                                 {"share_removed", share_of(x, c)},
                                 {"rms_over_noise", over_noise(x, c)},
                                 {"delta_bic", c.bic - x.declared.bic}});
    add_laws(c, out["candidates"].back());
  }
  out["after"] = nullptr;
  if (won)
    out["after"] = {{"parameters", parameters(x.best(), true)},
                    {"rms", rms_of(x.best(), x.unit)},
                    {"chi2_per_dof", or_null(x.best().chi2_per_dof)},
                    {"share_removed", share_of(x, x.best())},
                    {"rms_over_noise", over_noise(x, x.best())}};
  if (won) add_laws(x.best(), out["after"]);
  out["remaining"] = nullptr;
  if (x.remaining)
    out["remaining"] = {{"share", x.remaining->share},
                        {"rms_over_noise", over_noise(x, x.best())},
                        {"signature", signature(x.remaining->signature)},
                        {"text", x.remaining->text}};
  out["noise"] = noise_of(x);
  out["warnings"] = x.warnings;
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
  if (x.mended) file["experiments"] = mended_experiments(file["experiments"], *x.mended);
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
