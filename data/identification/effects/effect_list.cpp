#include "data/identification/effects/effect_list.h"

#include <fmt/format.h>

#include <algorithm>

namespace ostium::data {

// Each is defined in the source file of its name, which states its law.
Effect rest_curvature();
Effect soft_section();
Effect bending_anisotropy();
Effect superelastic_softening();
Effect lumped_mass();
Effect self_weight();
Effect roll_loss();
Effect clamp_runout();
Effect insertion_slip();
Effect registration();
Effect imaging_scale();
Effect shaft_torsion();
Effect nesting_clearance();
Effect stress_relaxation();
Effect wall_friction();
Effect wall_compliance();
Effect taper();
Effect torsion_ratio();
Effect level();
Effect view_angle();
Effect view_shift();
Effect source_distance();
Effect pincushion();
Effect s_distortion();
Effect table_sag();
Effect gantry_flex();
Effect second_plane_late();
Effect law_stiffness();
Effect law_bending();

const std::vector<Effect>& effects() {
  static const std::vector<Effect> all = {rest_curvature(),
                                          soft_section(),
                                          bending_anisotropy(),
                                          superelastic_softening(),
                                          lumped_mass(),
                                          self_weight(),
                                          roll_loss(),
                                          clamp_runout(),
                                          insertion_slip(),
                                          registration(),
                                          imaging_scale(),
                                          shaft_torsion(),
                                          nesting_clearance(),
                                          stress_relaxation(),
                                          wall_friction(),
                                          wall_compliance(),
                                          taper(),
                                          torsion_ratio(),
                                          level(),
                                          view_angle(),
                                          view_shift(),
                                          source_distance(),
                                          pincushion(),
                                          s_distortion(),
                                          table_sag(),
                                          gantry_flex(),
                                          second_plane_late(),
                                          law_stiffness(),
                                          law_bending()};
  return all;
}

namespace {

std::string known_ids() {
  std::string known;
  for (const Effect& effect : effects()) known += (known.empty() ? "" : ", ") + effect.id;
  return known;
}

const Effect* find(const std::string& id) {
  const auto found = std::find_if(effects().begin(), effects().end(), [&](const Effect& e) { return e.id == id; });
  return found == effects().end() ? nullptr : &*found;
}

ActiveEffect declared_effect(const DeclaredEffect& entry, const MeasurementSet& set) {
  const auto fail = [&](const std::string& what) { throw LoadError(entry.place + what); };
  const Effect* effect = find(entry.id);
  if (!effect) fail(fmt::format(".id is \"{}\"; expected one of {}", entry.id, known_ids()));
  if (const std::string why = effect->why_not(set, entry.instrument); !why.empty())
    fail(fmt::format(": {} cannot act here: {}", entry.id, why));
  ActiveEffect active{effect, entry.instrument, {}, {}, ""};
  for (const EffectParameter& p : effect->parameters) active.values.push_back(p.prior);
  for (const auto& [name, value] : entry.parameters) {
    const auto p = std::find_if(effect->parameters.begin(), effect->parameters.end(),
                                [&, key = &name](const EffectParameter& q) { return q.name == *key; });
    if (p == effect->parameters.end()) {
      std::string known;
      for (const EffectParameter& q : effect->parameters) known += (known.empty() ? "" : ", ") + q.name;
      fail(fmt::format(".parameters.{} is not a parameter of {}; expected one of {}", name, entry.id, known));
    }
    if (!(value >= p->least && value <= p->most))
      fail(fmt::format(".parameters.{} is {}; expected {}, {} to {}", name, value, p->what, p->least, p->most));
    active.values[p - effect->parameters.begin()] = value;
  }
  return active;
}

}  // namespace

bool often_confused(const std::string& a, const std::string& b) {
  const auto names = [](const std::string& id, const std::string& other) {
    const Effect* effect = find(id);
    return effect && effect->confused_with == other;
  };
  return names(a, b) || names(b, a);
}

namespace {

std::vector<ActiveEffect> to_try(const MeasurementSet& set, bool laws) {
  std::vector<ActiveEffect> out;
  for (const Effect& effect : effects()) {
    if ((effect.law != nullptr) != laws) continue;
    std::vector<std::optional<int>> on = {std::nullopt};
    if (effect.of_one_instrument && set.instruments.size() > 1)
      for (std::size_t i = 0; i < set.instruments.size(); ++i) on.emplace_back(static_cast<int>(i));
    for (const std::optional<int>& instrument : on) {
      if (!effect.why_not(set, instrument).empty()) continue;
      const std::vector<EffectForm> forms =
          effect.forms ? effect.forms(set, instrument) : std::vector<EffectForm>{{"", {}}};
      for (const EffectForm& form : forms) out.push_back(active(effect, set, instrument, form));
    }
  }
  return out;
}

}  // namespace

std::vector<ActiveEffect> everything_to_try(const MeasurementSet& set) { return to_try(set, false); }

std::vector<ActiveEffect> laws_to_try(const MeasurementSet& set) { return to_try(set, true); }

const Effect& find_effect(const std::string& id) {
  const Effect* effect = find(id);
  if (!effect) throw LoadError(fmt::format("there is no effect \"{}\"; there are {}", id, known_ids()));
  return *effect;
}

std::vector<ActiveEffect> declared_effects(const MeasurementSet& set) {
  std::vector<ActiveEffect> active;
  for (const DeclaredEffect& entry : set.effects) active.push_back(declared_effect(entry, set));
  return active;
}

}  // namespace ostium::data
