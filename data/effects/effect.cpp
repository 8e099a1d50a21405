#include "data/effects/effect.h"

#include <fmt/format.h>

#include <algorithm>

#include "data/effects/roll_loss.h"
#include "data/effects/shaft_torsion.h"
#include "data/effects/stress_relaxation.h"

namespace ostium {

const std::vector<Effect>& effects() {
  static const std::vector<Effect> all = {shaft_torsion(), roll_loss(), stress_relaxation()};
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

ActiveEffect declared(const DeclaredEffect& entry, const MeasurementSet& set) {
  const auto fail = [&](const std::string& what) { throw LoadError(entry.place + what); };
  const Effect* effect = find(entry.id);
  if (!effect) fail(fmt::format(".id is \"{}\"; expected one of {}", entry.id, known_ids()));
  if (const std::string why = effect->why_not(set, entry.instrument); !why.empty())
    fail(fmt::format(": {} cannot act here: {}", entry.id, why));
  ActiveEffect active{effect, entry.instrument, {}};
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

const Effect& find_effect(const std::string& id) {
  const Effect* effect = find(id);
  if (!effect) throw LoadError(fmt::format("there is no effect \"{}\"; there are {}", id, known_ids()));
  return *effect;
}

std::vector<ActiveEffect> declared_effects(const MeasurementSet& set) {
  std::vector<ActiveEffect> active;
  for (const DeclaredEffect& entry : set.effects) active.push_back(declared(entry, set));
  return active;
}

}  // namespace ostium
