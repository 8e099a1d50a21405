#include "data/identification/characterisation/stiffness_estimate.h"

#include <cmath>

#include "core/base/units.h"
#include "data/formats/json/json_object.h"
#include "data/identification/forward/setup.h"

namespace ostium::data {

namespace {

using units::mm, units::Nmm2;

/// Of the variance of the prior, what a posterior must fall below to say something of its own.
constexpr double most_of_prior = 0.5;
constexpr const char* friction_id = "wall_friction";

/// The scale of section `s` among the fitted numbers; null if its fit had none.
const FittedParameter* scale_of(const MeasuredInstrument& instrument, std::size_t s, const FittedModel& model) {
  // Sections of one stiffness share the scale of the first.
  std::size_t first = 0;
  while (instrument.sections[first].EI1_N_m2 != instrument.sections[s].EI1_N_m2 ||
         instrument.sections[first].GJ_N_m2 != instrument.sections[s].GJ_N_m2)
    ++first;
  for (const FittedParameter& p : model.parameters)
    if (p.parameter.name == "EI_scale[0]" || p.parameter.name == "EI_scale[0][" + std::to_string(first) + "]")
      return &p;
  return nullptr;
}

/// Index of the section that a scale of a set of curves is of; none for another parameter.
std::optional<std::size_t> section_of(const std::string& label, const std::string& key) {
  const std::string head = key + "_scale[";
  if (label.rfind(head, 0) != 0) return {};
  return static_cast<std::size_t>(std::stoul(label.substr(head.size())));
}

const JsonValue& root_of(const JsonValue& root, const curves::CurveExplanation& found) {
  const auto& fault = found.best().fault;
  return fault && fault->root ? *fault->root : root;
}

}  // namespace

LogScale without_prior(double scale, double sigma, double spread) {
  const double posterior = sigma * sigma / (scale * scale), prior = spread * spread;
  if (posterior > most_of_prior * prior) return {};
  const double variance = 1 / (1 / posterior - 1 / prior);
  return {variance * std::log(scale) / posterior, std::sqrt(variance)};
}

std::vector<StiffnessEstimate> estimates_of(const MeasurementSet& as_read, const Explanation& found) {
  const MeasurementSet& set = found.judged(as_read);
  const FittedModel& model = found.best();
  const std::vector<core::Section> fitted =
      setup_of(set, set.experiments.front(), model.changes).nest.parts[0].sections;
  std::vector<StiffnessEstimate> out;
  for (const core::Section& f : fitted) {
    const auto& declared = set.instruments[0].sections;
    std::size_t s = 0;
    while (s + 1 < declared.size() && declared[s].to_tip_m < (f.from_tip_m + f.to_tip_m) / 2) ++s;
    const FittedParameter* scale = scale_of(set.instruments[0], s, model);
    if (!scale) continue;
    const LogScale own = without_prior(scale->value, scale->sigma, scale->parameter.spread);
    if (own.sigma == 0) continue;
    out.push_back({Stiffness::bending, f.from_tip_m, f.to_tip_m,
                   0.5 * (f.EI1_N_m2 + f.EI2_N_m2) / scale->value * std::exp(own.mean), own.sigma});
  }
  return out;
}

std::vector<StiffnessEstimate> estimates_of(const JsonValue& as_read, const curves::CurveExplanation& found) {
  std::vector<StiffnessEstimate> out;
  const JsonValue* instruments = root_of(as_read, found).find("instruments");
  if (!instruments || instruments->items.empty()) return out;
  const JsonValue* sections = instruments->items[0].find("sections");
  if (!sections) return out;
  for (const auto& [of, key] : {std::pair{Stiffness::bending, "EI"}, std::pair{Stiffness::torsion, "GJ"}})
    for (const curves::Fitted& f : found.best().parameters) {
      const std::optional<std::size_t> s = section_of(f.label, key);
      if (!s) continue;
      const LogScale own = without_prior(f.value, f.sigma, f.parameter.spread);
      if (own.sigma == 0) continue;
      const JsonValue& section = sections->items.at(*s);
      const std::vector<JsonValue>& ends = section.find("from_tip_mm")->items;
      out.push_back({of, ends[0].number * mm, ends[1].number * mm,
                     section.find(std::string(key) + "_Nmm2")->number * Nmm2 * std::exp(own.mean), own.sigma});
    }
  return out;
}

std::optional<FrictionEstimate> friction_of(const JsonValue& as_read, const curves::CurveExplanation& found) {
  const curves::Candidate& best = found.best();
  const std::vector<curves::EffectHead>& heads = best.set->effects();
  const auto known =
      std::find_if(heads.begin(), heads.end(), [](const curves::EffectHead& e) { return e.id == friction_id; });
  if (known == heads.end() || !root_of(as_read, found).find("rig")) return {};
  const auto friction = static_cast<std::size_t>(known - heads.begin());
  std::vector<std::size_t> effects;
  for (const curves::Switched& s : best.model.on) effects.push_back(s.effect);
  if (std::find(effects.begin(), effects.end(), friction) == effects.end()) effects.push_back(friction);
  const curves::Fit fit(*best.set, found.noise, best.fault ? best.fault->chosen : std::vector<std::vector<bool>>{});
  const curves::Model model = fit.run(effects, &best.model);
  for (const curves::Fitted& f : fit.parameters(model))
    if (f.label.rfind(friction_id, 0) == 0 && f.informed > 1 - most_of_prior) return FrictionEstimate{f.value, f.sigma};
  return {};
}

}  // namespace ostium::data
